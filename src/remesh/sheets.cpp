#include "remesh/sheets.hpp"

#include <tbb/parallel_for.h>

#include <optional>

namespace meshgraft {
namespace {

/// All sheets must see the same sizes on the curves between them.
void settle_sizes_of_curves(Editor& editor) {
  const LocalMesh& mesh = editor.mesh();
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    const LocalFace& face = mesh.face(FaceId(f));
    if (!face.alive || !face.in_zone) continue;
    for (const VertexId v : face.v)
      if (mesh.vertex(v).dimension != Dimension::kSheet) editor.size(v);
  }
}

}  // namespace

void in_each_sheet(Editor& editor, const std::function<void(Editor& sheet)>& work) {
  settle_sizes_of_curves(editor);
  const auto faces = editor.mesh().faces_by_sheet();
  std::vector<std::optional<Editor>> piece(faces.size());
  const auto make = [&](std::size_t s) {
    piece[s].emplace(editor, SheetId(s), faces[s]);
    work(*piece[s]);
  };
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, faces.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t s = range.begin(); s < range.end(); ++s)
          if (!faces[s].empty()) make(s);
      },
      tbb::simple_partitioner());
  for (std::size_t s = 0; s < faces.size(); ++s) {
    if (!piece[s]) continue;
    if (editor.clashes_with(*piece[s])) make(s);  // again, with what the sheets before it have become
    editor.absorb(*piece[s]);
    piece[s].reset();
  }
}

}  // namespace meshgraft
