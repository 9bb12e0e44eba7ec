// The command line of `meshgraft cut`.
#pragma once

#include "cli/command_reader.hpp"

namespace meshgraft::cli {

class CutReader : public CommandReader<CutArguments> {
 public:
  explicit CutReader(CLI::App& app);

 private:
  Result<void> read_own() override;
  [[nodiscard]] Result<void> read_tool();
};

}  // namespace meshgraft::cli
