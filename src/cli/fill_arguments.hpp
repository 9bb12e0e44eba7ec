// The command line of `meshgraft fill`.
#pragma once

#include "cli/command_reader.hpp"

namespace meshgraft::cli {

class FillReader : public CommandReader<FillArguments> {
 public:
  explicit FillReader(CLI::App& app);

 private:
  Result<void> read_own() override;
  [[nodiscard]] Result<void> read_contours();

  std::vector<std::string> numbers_;
};

}  // namespace meshgraft::cli
