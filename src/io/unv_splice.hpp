// The text of a merge: the base's text with changed records replaced.
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshgraft/merge.hpp"
#include "meshgraft/report.hpp"

namespace meshgraft::unv {

class Splice;

/// Pieces of text in order. They live as long as this object and the inputs.
class SplicedText {
 public:
  /// Inputs without a text of their own are given one. `report` receives untouched bytes, the fate
  /// of datasets, and warnings. Error kLabelOverflow.
  [[nodiscard]] static Result<SplicedText> make(const Model& base, std::span<const Model> parts, const Merged& merged,
                                                Report& report);
  SplicedText(SplicedText&&) noexcept;
  SplicedText& operator=(SplicedText&&) = delete;
  ~SplicedText();

  std::vector<std::string_view> pieces;
  [[nodiscard]] std::string_view side_file() const;

 private:
  SplicedText();
  std::deque<Model> made_;  // inputs that were given a text
  std::unique_ptr<Splice> splice_;
};

}  // namespace meshgraft::unv
