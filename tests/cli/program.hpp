// Runs the built program in a folder of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "meshgraft/model.hpp"

namespace meshgraft::cli_tests {

struct Outcome {
  int code = -1;  // exit code; 128 + number after a signal
  std::string out, err;
};

/// Where stderr of the program goes.
enum class Stderr { kFile, kTerminal };

/// A new empty folder, removed with all it holds at the end.
class Folder {
 public:
  Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder();

  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] std::filesystem::path path() const { return path_; }
  /// Names of all files, ascending.
  [[nodiscard]] std::vector<std::string> files() const;

  /// Runs meshgraft in this folder; file names may be relative to it.
  [[nodiscard]] Outcome run(const std::vector<std::string>& arguments, Stderr where = Stderr::kFile) const;
  [[nodiscard]] Outcome run_program(const std::string& program, const std::vector<std::string>& arguments,
                                    Stderr where = Stderr::kFile, const std::string& stdout_path = {}) const;

  void put(const std::string& name, const std::string& text) const;
  void put(const std::string& name, const Model& model) const;
  [[nodiscard]] std::string text(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& name) const;

  /// base.unv: a plate; part.unv: a plate that crosses it; far.unv: one that does not meet it.
  void put_plates() const;

 private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string read_text(const std::filesystem::path& path);

}  // namespace meshgraft::cli_tests
