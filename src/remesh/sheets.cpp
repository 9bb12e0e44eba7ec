#include "remesh/sheets.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "core/blocks.hpp"

namespace meshgraft {
namespace {

constexpr std::size_t kSizeBlock = 256;  // vertices at which the size is asked for in one go

/// All sheets must see the same sizes on the curves between them.
void settle_sizes_of_curves(Editor& editor) {
  const LocalMesh& mesh = editor.mesh();
  const auto is_in_zone = [&](FaceId f) { return mesh.face(f).in_zone; };
  for_blocks(
      mesh.n_vertices(),
      [&](std::size_t first, std::size_t last) {
        for (VertexId v(first); v.value < last; ++v.value)
          if (mesh.vertex(v).dimension != Dimension::kSheet && std::ranges::any_of(mesh.star(v), is_in_zone))
            editor.size(v);
      },
      kSizeBlock);
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
