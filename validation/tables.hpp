// The tables of the study, as Markdown.
#pragma once

#include <string>
#include <vector>

#include "compare.hpp"
#include "solve.hpp"
#include "structure.hpp"

namespace meshgraft::validation {

enum class Role { kRefined, kCad, kMerged };

/// A mesh of the assembly with its solution.
struct Case {
  std::string name;
  Role role = Role::kCad;
  Structure structure;
  Response response;
};

struct Tables {
  std::string text;                // the tables
  std::vector<std::string> unmet;  // aims of the study that the figures do not meet
};

/// Frequencies and stresses of all cases beside those of the refined one.
///
/// REQUIRES: exactly one case is kRefined, at least two are kCad, at least one is kMerged.
///   margin   faces nearer than this to lines where stresses are singular are left out of the stresses; mm
[[nodiscard]] Tables tables_of(const std::vector<Case>& cases, const Study& study, double margin);

/// How far the frequencies of meshes of several edge lengths are from those of the refined one: a row for each mesh of
/// `cases` but that one, then for each of `others`.
///
/// REQUIRES: exactly one of `cases` is kRefined.
[[nodiscard]] std::string convergence_of(const std::vector<Case>& cases, const std::vector<Case>& others,
                                         const Study& study);

}  // namespace meshgraft::validation
