#include "program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "meshgraft/unv.hpp"
#include "support/scenes.hpp"

namespace meshgraft::cli_tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOut = ".stdout";
constexpr const char* kErr = ".stderr";

/// The two ends of a pseudo-terminal.
struct Terminal {
  int ours = -1, theirs = -1;
  Terminal() {
    ours = ::posix_openpt(O_RDWR | O_NOCTTY);
    if (ours < 0 || ::grantpt(ours) != 0 || ::unlockpt(ours) != 0) return;
    theirs = ::open(::ptsname(ours), O_RDWR | O_NOCTTY);
  }
  /// What was shown, once the program has closed its end.
  std::string shown() {
    ::close(theirs);
    std::string text;
    char buffer[4096];
    for (ssize_t n = 0; (n = ::read(ours, buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<std::size_t>(n));
    ::close(ours);
    return text;
  }
};

[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments, const fs::path& folder,
                         const std::string& out, int err) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  const int out_fd = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (::chdir(folder.c_str()) == 0 && ::dup2(out_fd, STDOUT_FILENO) >= 0 && ::dup2(err, STDERR_FILENO) >= 0)
    ::execv(program.c_str(), argv.data());
  ::_exit(127);
}

}  // namespace

std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "meshgraft-cli-XXXXXX").string();
  EXPECT_NE(::mkdtemp(name.data()), nullptr);
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> Folder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    if (name != kOut && name != kErr) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

Outcome Folder::run(const std::vector<std::string>& arguments, Stderr where) const {
  return run_program(MESHGRAFT_PROGRAM, arguments, where);
}

Outcome Folder::run_program(const std::string& program, const std::vector<std::string>& arguments, Stderr where,
                            const std::string& stdout_path) const {
  const std::string out = stdout_path.empty() ? *this / kOut : stdout_path;
  Terminal terminal;
  const int err =
      where == Stderr::kTerminal ? terminal.theirs : ::open((*this / kErr).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  EXPECT_GE(err, 0);
  const pid_t child = ::fork();
  if (child == 0) become(program, arguments, path_, out, err);
  Outcome outcome;
  if (where == Stderr::kTerminal) {
    outcome.err = terminal.shown();
  } else {
    ::close(err);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (stdout_path.empty()) outcome.out = text(kOut);
  if (where == Stderr::kFile) outcome.err = text(kErr);
  return outcome;
}

void Folder::put(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
}

void Folder::put(const std::string& name, const Model& model) const {
  const auto written = write_unv(model, *this / name);
  ASSERT_TRUE(written) << to_string(written.error());
}

std::string Folder::text(const std::string& name) const { return read_text(path_ / name); }

bool Folder::has(const std::string& name) const { return fs::exists(path_ / name); }

void Folder::put_plates() const {
  constexpr double kSize = 0.1;
  put("base.unv", scenes::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, kSize, "WALL"));
  put("part.unv", scenes::plate({0.23, 0.47, -0.2}, {0.5, 0.02, 0}, {0, 0, 0.5}, kSize, "RIB"));
  put("far.unv", scenes::plate({5, 5, 5}, {1, 0, 0}, {0, 1, 0}, kSize, "FAR"));
}

}  // namespace meshgraft::cli_tests
