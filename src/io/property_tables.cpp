#include "io/property_tables.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "io/unv_numbers.hpp"

namespace meshgraft::unv {
namespace {

constexpr std::array<std::int64_t, 5> kPropertyTables{775, 788, 2437, 2448, 2470};
constexpr std::array<std::int64_t, 2> kMaterialTables{773, 1716};
constexpr std::int64_t kFirstLibraryTable = 1700, kLastLibraryTable = 1710;  // materials

bool is_material_table(std::int64_t number) {
  return std::ranges::count(kMaterialTables, number) != 0 ||
         (number >= kFirstLibraryTable && number <= kLastLibraryTable);
}

std::string text_of(const Document& d, const Dataset& dataset) {
  std::string text;
  for (std::size_t at = dataset.body; at < dataset.body_end;) {
    const Line line = d.lines.at(at, dataset.body_end);
    text.append(right_trimmed(d.lines.view(line))).append("\n");
    at = line.next;
  }
  return text;
}

/// Whether `text` holds `part` in whole lines.
bool holds(std::string_view text, std::string_view part) {
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
    if (at == 0 || text[at - 1] == '\n') return true;
  return false;
}

/// Integers in the first field of a line; that of a record which defines a number is among them.
std::set<std::int64_t> first_fields(std::string_view text) {
  std::set<std::int64_t> found;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (const auto value = parse_integer(trimmed(line.substr(0, kIntegerWidth)))) found.insert(*value);
    text.remove_prefix(line.size() + 1);
  }
  return found;
}

/// Those of `used` that `defined` has; all of them if it has none, for then the records are of another form.
std::set<std::int64_t> common(const std::set<std::int64_t>& used, const std::set<std::int64_t>& defined) {
  std::set<std::int64_t> both;
  std::ranges::set_intersection(used, defined, std::inserter(both, both.end()));
  return both.empty() ? used : both;
}

}  // namespace

struct PropertyTables::Numbers {
  std::set<std::int64_t> physical, material;
  [[nodiscard]] bool empty() const { return physical.empty() && material.empty(); }
  [[nodiscard]] bool are_of(const ElementAttributes& a) const {
    return physical.contains(a.physical) || material.contains(a.material);
  }
  [[nodiscard]] std::string text() const {
    std::string all;
    for (const auto& [what, numbers] : {std::pair{"property ", &physical}, std::pair{"material ", &material}})
      for (const std::int64_t n : *numbers) all += (all.empty() ? "" : ", ") + (what + std::to_string(n));
    return all;
  }
};

bool is_property_table(const Dataset& dataset) {
  return !dataset.binary &&
         (is_material_table(dataset.number) || std::ranges::count(kPropertyTables, dataset.number) != 0);
}

PropertyTables::PropertyTables(std::span<const Model* const> models, std::span<const Document* const> documents)
    : models_(models), documents_(documents) {
  for (const Dataset& dataset : documents.front()->datasets)
    if (is_property_table(dataset)) (void)add(0, dataset);
}

PropertyTables::Fate PropertyTables::add(std::uint32_t input, const Dataset& dataset) {
  Table table{input, &dataset, text_of(*documents_[input], dataset), Fate::kNew};
  for (const Table& other : tables_) {
    if (other.input == input || other.fate != Fate::kNew || other.dataset->number != dataset.number) continue;
    table.fate = Fate::kDiffers;
    if (!holds(other.text, table.text)) continue;
    table.fate = Fate::kSame;
    break;
  }
  tables_.push_back(std::move(table));
  return tables_.back().fate;
}

std::vector<Warning> PropertyTables::warnings(std::uint32_t input) const {
  std::vector<Warning> all;
  for (const auto& warning : {clash(input), taken_over(input)})
    if (warning) all.push_back(*warning);
  return all;
}

std::optional<Warning> PropertyTables::clash(std::uint32_t input) const {
  std::vector<const Table*> here, there;
  for (const Table& table : tables_)
    if (table.input == input && table.fate == Fate::kDiffers) here.push_back(&table);
  for (const Table& table : tables_)
    if (table.input < input && table.fate == Fate::kNew &&
        std::ranges::any_of(here, [&](const Table* t) { return t->dataset->number == table.dataset->number; }))
      there.push_back(&table);
  const Numbers numbers = numbers_in(here, input);
  if (numbers.empty()) return std::nullopt;
  return documents_[input]->warning("property-tables",
                                    numbers.text() + " of " + elements_with(numbers, input) + ": the tables differ, " +
                                        named(here) + " here, " + named(there) +
                                        "; the output has the latter only, and these elements mean what is said "
                                        "there. The tables of this file are in the side file",
                                    here.front()->dataset->number_line);
}

std::optional<Warning> PropertyTables::taken_over(std::uint32_t input) const {
  std::vector<const Table*> here;
  for (const Table& table : tables_)
    if (table.input == input && table.fate == Fate::kNew) here.push_back(&table);
  if (here.empty()) return std::nullopt;
  std::string whose;
  for (std::uint32_t k = 0; k < input; ++k) {
    const Numbers own = numbers_in(here, input), before = used_by(k);
    Numbers both;
    std::ranges::set_intersection(own.physical, before.physical, std::inserter(both.physical, both.physical.end()));
    std::ranges::set_intersection(own.material, before.material, std::inserter(both.material, both.material.end()));
    if (!both.empty())
      whose += (whose.empty() ? "" : "; ") + both.text() + " of " + elements_with(both, k) + " of " + path_of(k);
  }
  if (whose.empty()) return std::nullopt;
  return documents_[input]->warning("property-tables",
                                    whose + " had no such table, and mean what is said in " + named(here) + " now",
                                    here.front()->dataset->number_line);
}

std::string PropertyTables::named(const std::vector<const Table*>& tables) const {
  constexpr std::size_t kNamed = 4;
  std::string text;
  for (std::size_t k = 0; k < std::min(tables.size(), kNamed); ++k) {
    const Table& t = *tables[k];
    text += (k == 0 ? "dataset " : ", ") + std::to_string(t.dataset->number) + " (" + path_of(t.input) + ":" +
            std::to_string(documents_[t.input]->line_of(t.dataset->number_line)) + ")";
  }
  return tables.size() > kNamed ? text + " and " + std::to_string(tables.size() - kNamed) + " more" : text;
}

PropertyTables::Numbers PropertyTables::numbers_in(const std::vector<const Table*>& tables, std::uint32_t input) const {
  std::string physical, material;
  for (const Table* table : tables) (is_material_table(table->dataset->number) ? material : physical) += table->text;
  const Numbers used = used_by(input);
  Numbers numbers;
  if (!physical.empty()) numbers.physical = common(used.physical, first_fields(physical));
  if (!material.empty()) numbers.material = common(used.material, first_fields(material));
  return numbers;
}

PropertyTables::Numbers PropertyTables::used_by(std::uint32_t input) const {
  Numbers used;
  for (const ElementAttributes& a : models_[input]->attributes)
    used.physical.insert(a.physical), used.material.insert(a.material);
  used.physical.erase(0), used.material.erase(0);  // 0: none
  return used;
}

std::string PropertyTables::elements_with(const Numbers& numbers, std::uint32_t input) const {
  const Model& model = *models_[input];
  std::size_t n = 0;
  std::int64_t first = 0;
  for (std::size_t e = 0; e < model.n_elements(); ++e) {
    if (!numbers.are_of(model.attributes_of(ElementId(e)))) continue;
    if (n++ == 0) first = model.element_label[e];
  }
  return n == 1 ? "element " + std::to_string(first)
                : std::to_string(n) + " elements (the first is " + std::to_string(first) + ")";
}

}  // namespace meshgraft::unv
