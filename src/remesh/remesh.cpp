#include "remesh/remesh.hpp"

#include "remesh/editor.hpp"
#include "remesh/front.hpp"
#include "remesh/improve.hpp"
#include "remesh/resample.hpp"
#include "remesh/result.hpp"
#include "remesh/sheets.hpp"
#include "remesh/zone_end.hpp"

namespace meshgraft {
namespace {

constexpr double kComfortable = 0.65;  // Q below which a face is mended for the sake of the mean
constexpr double kAmbitious = 0.75;    // the same where the mean is below the wanted one
constexpr double kMargin = 0.05;       // above the wanted Q, so that rounding in files cannot spoil it

}  // namespace

Remeshed remesh(const Complex& complex, const Brep& brep, const Sizing& sizing,
                const std::vector<std::uint8_t>& in_zone, GroupSets& groups, const RemeshOptions& options) {
  Editor editor(complex, brep, in_zone, sizing, options);
  resample_curves(editor, complex, brep, sizing, options.loose);
  in_each_sheet(editor, [](Editor& sheet) {
    advance_front(sheet);
    relax_all(sheet);
  });
  relax_curves(editor);
  in_each_sheet(editor, [](Editor& sheet) {
    relax_all(sheet);
    fit_to_size(sheet);
    relax_all(sheet);
    regularise(sheet);
  });
  mend(editor, kComfortable);
  if (editor.mesh().mean_quality() < options.wanted_mean) {
    in_each_sheet(editor, [](Editor& sheet) {
      regularise(sheet, Irregularity::kNotMore);
      relax_all(sheet);
    });
    mend(editor, kAmbitious);
  }
  relax_curves(editor);
  in_each_sheet(editor, [](Editor& sheet) { relax_all(sheet); });
  std::vector<VertexId> let_go = release_poor(editor, options.min_quality + kMargin);
  mend(editor, options.min_quality + kMargin);
  Remeshed remeshed = to_remeshed(editor, complex, brep, in_zone, groups);
  remeshed.let_go = std::move(let_go);
  return remeshed;
}

Remeshed remesh(const Complex& complex, const Brep& brep, const SizeField& size,
                const std::vector<std::uint8_t>& in_zone, GroupSets& groups, const RemeshOptions& options) {
  return remesh(complex, brep, sizing_in_zone(complex, brep, size, in_zone), in_zone, groups, options);
}

}  // namespace meshgraft
