// Datasets that property and material numbers of elements point to. Their records are not understood, but they name
// neither nodes nor elements; and two files may mean different things by one number.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/unv_document.hpp"
#include "meshgraft/model.hpp"

namespace meshgraft::unv {

[[nodiscard]] bool is_property_table(const Dataset& dataset);

/// The tables of an output, input by input.
class PropertyTables {
 public:
  PropertyTables(std::span<const Model* const> models, std::span<const Document* const> documents);

  enum class Fate : std::uint8_t {
    kNew,     // no input before has a dataset of that number: it goes into the output
    kSame,    // its text is in the output already
    kDiffers  // the output has another one
  };
  [[nodiscard]] Fate add(std::uint32_t input, const Dataset& dataset);

  /// property-tables: numbers that elements of this input use and that mean something else in the output now, or
  /// that elements of inputs before use without having had a table. To be called after all tables of the input.
  [[nodiscard]] std::vector<Warning> warnings(std::uint32_t input) const;

 private:
  struct Table {
    std::uint32_t input;
    const Dataset* dataset;
    std::string text;  // of the records, with LF and without trailing blanks
    Fate fate;
  };
  struct Numbers;

  [[nodiscard]] std::string named(const std::vector<const Table*>& tables) const;
  [[nodiscard]] std::string path_of(std::uint32_t input) const { return models_[input]->path; }
  [[nodiscard]] Numbers numbers_in(const std::vector<const Table*>& tables, std::uint32_t input) const;
  [[nodiscard]] Numbers used_by(std::uint32_t input) const;
  [[nodiscard]] std::string elements_with(const Numbers& numbers, std::uint32_t input) const;
  [[nodiscard]] std::optional<Warning> clash(std::uint32_t input) const;
  [[nodiscard]] std::optional<Warning> taken_over(std::uint32_t input) const;

  std::span<const Model* const> models_;
  std::span<const Document* const> documents_;
  std::vector<Table> tables_;
};

}  // namespace meshgraft::unv
