// Datasets that are not understood: those of the base stay, those of the parts are copied if they
// can be, else they go to the side file. Each gets an entry in the report. Tables of properties name no labels, so that
// they are copied where the output has none of that number yet, also where labels changed.
#include <algorithm>
#include <array>

#include "io/coordinate_systems.hpp"
#include "io/property_tables.hpp"
#include "io/side_file.hpp"
#include "io/splice_context.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::array<std::int64_t, 9> kCarryLabels{55, 56, 57, 58, 2414, 757, 791, 82, 2431};
constexpr std::array<std::int64_t, 3> kHeaders{151, 164, 2400};

std::string number_of(const Dataset& dataset) { return std::to_string(dataset.number) + (dataset.binary ? "b" : ""); }

DatasetEntry entry(std::uint32_t input, const Document& d, const Dataset& dataset, std::string fate) {
  DatasetEntry e;
  e.input = input, e.number = number_of(dataset), e.line = d.line_of(dataset.number_line);
  e.bytes = dataset.end - dataset.open, e.fate = std::move(fate);
  return e;
}

/// Whether the base has every system of the dataset under the same label.
bool systems_in_base(const Model& base, const Document& part, const Dataset& dataset) {
  const auto systems = coordinate_systems(part.lines, dataset);
  return systems && std::ranges::all_of(*systems, [&](const CoordinateSystem& system) {
           return system.is_global() || system.same_as(base.coordinate_system(system.label));
         });
}

bool same_as_base(const Model& base, const Document& part, const Dataset& dataset) {
  if (dataset.binary) return false;
  if (holds_systems(dataset)) return systems_in_base(base, part, dataset);
  return std::ranges::count(kHeaders, dataset.number) != 0;
}

bool labels_changed(const Splice& s, std::uint32_t k) {
  return !s.graft.removed_nodes[k].empty() || !s.graft.removed_elements[k].empty() ||
         !s.labels.shifted_nodes[k].empty() || !s.labels.shifted_elements[k].empty();
}

/// A dataset of a part from delimiter to delimiter; binary data byte for byte.
void append_dataset(const Splice& s, const Document& d, const Dataset& dataset, std::string& text) {
  s.close_dataset(text);
  if (dataset.binary) {
    text += d.text().substr(dataset.number_line, dataset.body_end - dataset.number_line);
  } else {
    append_lines(d.lines, dataset.number_line, dataset.body_end, s.line_end(), text);
  }
  s.close_dataset(text);
}

void put_aside(Splice& s, std::uint32_t k, const Dataset& dataset) {
  const Document& d = *s.documents[k];
  if (s.side_file.empty()) s.side_file += kSideFileMark, s.side_file += s.line_end();
  s.side_file += "input " + std::to_string(k) + ", " + d.path() + ", line " +
                 std::to_string(d.line_of(dataset.number_line)) + ": dataset " + number_of(dataset);
  s.side_file += s.line_end();
  append_dataset(s, d, dataset, s.side_file);
}

/// What becomes of a dataset of a part.
enum class Fate : std::uint8_t { kKept, kSame, kAside };

const char* name(Fate fate) {
  switch (fate) {
    case Fate::kKept:
      return "kept";
    case Fate::kSame:
      return "same as base";
    case Fate::kAside:
      break;
  }
  return "side file";
}

Fate fate_of(PropertyTables::Fate fate) {
  if (fate == PropertyTables::Fate::kDiffers) return Fate::kAside;
  return fate == PropertyTables::Fate::kNew ? Fate::kKept : Fate::kSame;
}

}  // namespace

void splice_datasets(Splice& s) {
  const bool removed = !s.graft.removed_nodes.front().empty() || !s.graft.removed_elements.front().empty();
  for (const Dataset& dataset : s.base().datasets) {
    if (dataset.kind() != DatasetKind::kOther) continue;
    const bool stale = removed && std::ranges::count(kCarryLabels, dataset.number) != 0;
    s.report.datasets.push_back(
        entry(0, s.base(), dataset, stale ? "kept, stale: may name nodes or elements that were removed" : "kept"));
  }
  PropertyTables tables(s.models, s.documents);
  TextPieces copies;
  for (std::uint32_t k = 1; k < s.n_inputs(); ++k) {
    const Document& d = *s.documents[k];
    const bool changed = labels_changed(s, k);
    for (const Dataset& dataset : d.datasets) {
      if (dataset.kind() != DatasetKind::kOther) continue;
      const Fate fate = is_property_table(dataset)                    ? fate_of(tables.add(k, dataset))
                        : same_as_base(*s.models.front(), d, dataset) ? Fate::kSame
                        : changed || holds_systems(dataset)  // labels of systems may be those of the base
                            ? Fate::kAside
                            : Fate::kKept;
      if (fate == Fate::kAside) put_aside(s, k, dataset);
      if (fate == Fate::kKept) append_dataset(s, d, dataset, copies.made());
      s.report.datasets.push_back(entry(k, d, dataset, name(fate)));
    }
    for (Warning& warning : tables.warnings(k)) s.report.warnings.push_back(std::move(warning));
  }
  s.append_text(std::move(copies));
}

}  // namespace meshgraft::unv
