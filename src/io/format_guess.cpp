#include <algorithm>
#include <array>

#include "io/line_scanner.hpp"
#include "io/unv_datasets.hpp"

namespace meshgraft::unv {
namespace {

struct Mark {
  std::string_view start, format;
};

constexpr Mark kMarks[] = {
    {"\x89HDF\r\n\x1a\n", "an HDF5 file, perhaps MED"},
    {"$MeshFormat", "a Gmsh mesh"},
    {"$NOD", "a Gmsh mesh"},
    {"$Comments", "a Gmsh mesh"},
    {"<?xml", "an XML file, perhaps VTK"},
    {"<VTKFile", "a VTK file"},
    {"# vtk DataFile", "a legacy VTK file"},
    {"INTERSPECTRE", "a Code_Aster text file"},
    {"TITRE", "a Code_Aster text file"},
    {"COOR_3D", "a Code_Aster text file"},
    {"COOR_2D", "a Code_Aster text file"},
    {"ply", "a PLY file"},
    {"OFF", "an OFF file"},
    {"COFF", "an OFF file"},
    {"solid", "an STL file"},
    {"SOL ", "a Nastran bulk data file"},
    {"CEND", "a Nastran bulk data file"},
    {"BEGIN BULK", "a Nastran bulk data file"},
    {"GRID", "a Nastran bulk data file"},
    {"\xFF\xFE", "text in UTF-16 (save it as UTF-8)"},
    {"\xFE\xFF", "text in UTF-16 (save it as UTF-8)"},
    {"%PDF", "a PDF document"},
    {"PK\x03\x04", "a ZIP archive"},
    {"\x1f\x8b", "a gzip archive"},
    {"ISO-10303-21", "a STEP file"},
};
constexpr std::size_t kLinesLookedAt = 50;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

}  // namespace

std::string_view likely_format(std::string_view text) {
  for (const Mark& mark : kMarks)
    if (text.starts_with(mark.start)) return mark.format;
  const LineScanner lines{text, '\n'};
  std::size_t at = 0;
  for (std::size_t k = 0; k < kLinesLookedAt && at < text.size(); ++k) {
    const Line line = lines.at(at);
    const std::string_view content = trimmed(lines.view(line));
    if (content.size() > 1 && content[0] == '*' && (is_letter(content[1]) || content[1] == '*'))
      return "an Abaqus or CalculiX input deck";
    if (content.starts_with("v ") || content.starts_with("vn ")) return "an OBJ file";
    if (content.starts_with("$ ")) return "a Nastran bulk data file";
    for (const Mark& mark : kMarks)
      if (mark.start.size() > 3 && content.starts_with(mark.start)) return mark.format;
    at = line.next;
  }
  return {};
}

}  // namespace meshgraft::unv
