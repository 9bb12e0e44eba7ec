// meshgraft_study: decks for CalculiX, and the tables of the study.
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <utility>

#include "calculix.hpp"
#include "meshgraft/unv.hpp"
#include "tables.hpp"

namespace meshgraft::validation {
namespace {

/// Meshes of one edge length that are compared with each other, and the finer one that they are measured by.
struct Meshes {
  std::string refined;
  std::vector<std::string> cad, merged;
  double size = 0;
};

struct Options {
  std::string study, model, output;
  Meshes shell, calculix;
  std::vector<std::string> others;  // of other edge lengths than those of `shell`, for the table of convergence
};

Result<Structure> read_structure(const std::string& path, const Study& study) {
  const auto model = read_unv(path);
  if (!model) return Failure(model.error());
  return structure_of(*model, study);
}

int failed(const Error& error) {
  std::cerr << to_string(error) << '\n';
  return 1;
}

int write_deck_of(const Options& options) {
  const auto study = read_study(options.study);
  if (!study) return failed(study.error());
  const auto structure = read_structure(options.model, *study);
  if (!structure) return failed(structure.error());
  std::ofstream out(options.output);
  write_deck(out, *structure, *study);
  out.flush();
  return out ? 0 : failed({ErrorCode::kCannotWrite, "cannot be written", "", {options.output, 0}});
}

/// Where the solution of a mesh comes from.
enum class Solver { kShell, kCalculix };

Result<Case> solved(const std::string& path, Role role, const Study& study, Solver solver) {
  auto structure = read_structure(path, study);
  if (!structure) return Failure(structure.error());
  const std::filesystem::path file(path);
  auto response = solver == Solver::kCalculix
                      ? read_calculix(std::filesystem::path(file).replace_extension().string(), *structure)
                      : solve(*structure, study);
  if (!response) return Failure(response.error());
  return Case{file.stem().string(), role, std::move(*structure), std::move(*response)};
}

Result<void> write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path);
  out << text << std::flush;
  return out ? Result<void>{} : failure(ErrorCode::kCannotWrite, "cannot be written", "", {path.string(), 0});
}

/// NAME.md, and the aims that are not met as a list in NAME.unmet.md.
Result<void> write_tables(const std::filesystem::path& name, const Tables& tables) {
  std::string list;
  for (const std::string& aim : tables.unmet) list += "- " + aim + '\n';
  if (list.empty()) list = "- none\n";
  const auto written = write(name.string() + ".md", tables.text);
  return written ? write(name.string() + ".unmet.md", list) : written;
}

/// A case of each of these files, solved side by side, as many at once as there are cores.
Result<std::vector<Case>> solved(const std::vector<std::pair<std::string, Role>>& files, const Study& study,
                                 Solver solver) {
  std::vector<std::optional<Result<Case>>> results(files.size());
  tbb::parallel_for(
      std::size_t{0}, files.size(),
      [&](std::size_t i) { results[i] = solved(files[i].first, files[i].second, study, solver); },
      tbb::simple_partitioner());
  std::vector<Case> cases;
  for (std::optional<Result<Case>>& one : results) {
    if (!*one) return Failure(one->error());
    cases.push_back(std::move(**one));
  }
  return cases;
}

std::vector<std::pair<std::string, Role>> files_of(const Meshes& meshes) {
  std::vector<std::pair<std::string, Role>> files{{meshes.refined, Role::kRefined}};
  for (const std::string& file : meshes.cad) files.emplace_back(file, Role::kCad);
  for (const std::string& file : meshes.merged) files.emplace_back(file, Role::kMerged);
  return files;
}

int write_all_tables(const Options& options) {
  const auto study = read_study(options.study);
  if (!study) return failed(study.error());
  const std::filesystem::path folder(options.output);
  const auto calculix = solved(files_of(options.calculix), *study, Solver::kCalculix);
  if (!calculix) return failed(calculix.error());
  const auto shell = solved(files_of(options.shell), *study, Solver::kShell);
  if (!shell) return failed(shell.error());
  std::vector<std::pair<std::string, Role>> files;
  for (const std::string& file : options.others) files.emplace_back(file, Role::kMerged);
  const auto others = solved(files, *study, Solver::kShell);
  if (!others) return failed(others.error());

  auto written = write_tables(folder / "calculix", tables_of(*calculix, *study, options.calculix.size));
  if (written) written = write_tables(folder / "shell", tables_of(*shell, *study, options.shell.size));
  if (written) written = write(folder / "convergence.md", convergence_of(*shell, *others, *study));
  return written ? 0 : failed(written.error());
}

/// Options --refined, --cad, --merged and --size, each with a prefix.
void add_meshes(CLI::App& app, const std::string& prefix, Meshes& meshes, const std::string& solver) {
  app.add_option(prefix + "refined", meshes.refined, "the mesh that the others are compared with, " + solver)
      ->required();
  app.add_option(prefix + "cad", meshes.cad, "meshes made from CAD, " + solver)->required()->expected(2, 9);
  app.add_option(prefix + "merged", meshes.merged, "merged meshes, " + solver)->required();
  app.add_option(prefix + "size", meshes.size, "edge length of these meshes, mm")->required();
}

}  // namespace
}  // namespace meshgraft::validation

int main(int argc, char** argv) {
  using namespace meshgraft::validation;
  Options options;
  CLI::App app{"The study of the caisson: the same analysis on merged meshes and on meshes made from CAD."};
  app.require_subcommand(1);
  CLI::App* deck = app.add_subcommand("deck", "writes an input file for CalculiX");
  deck->add_option("STUDY", options.study, "what the groups mean (JSON)")->required();
  deck->add_option("MODEL", options.model, "a universal file")->required();
  deck->add_option("-o,--output", options.output, "the input file")->required();
  CLI::App* tables = app.add_subcommand("tables",
                                        "writes the results side by side, by the shell triangle (shell.md, "
                                        "convergence.md) and by CalculiX (calculix.md)");
  tables->add_option("STUDY", options.study, "what the groups mean (JSON)")->required();
  add_meshes(*tables, "--", options.shell, "to be solved with the shell triangle of the study");
  add_meshes(*tables, "--calculix-", options.calculix, "with results of CalculiX beside them");
  tables->add_option("--others", options.others,
                     "meshes of other edge lengths, from CAD and merged: how the shell triangle converges");
  tables->add_option("-o,--output", options.output, "folder for the tables")->required();
  CLI11_PARSE(app, argc, argv);
  return deck->parsed() ? write_deck_of(options) : write_all_tables(options);
}
