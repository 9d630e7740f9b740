#pragma once
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/scratch_folder.h"

namespace strataflow::support {

inline std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

inline std::filesystem::path program() { return std::filesystem::path(STRATAFLOW_BINARY_DIR) / "bin" / "strataflow"; }

struct CommandOutcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs the program as a user would, with an empty home, and collects what it prints.
inline CommandOutcome strataflow(const std::vector<std::string>& arguments, const std::string& redirect = "") {
  const ScratchFolder scratch;
  const auto quoted = [](const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
  };
  std::string command =
      "unset XDG_CACHE_HOME; HOME=" + quoted(scratch.path().string()) + " NO_COLOR=1 " + quoted(program().string());
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  command += redirect.empty() ? " >" + quoted((scratch.path() / "out").string()) : " " + redirect;
  command += " 2>" + quoted((scratch.path() / "err").string());
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text(scratch.path() / "out"),
          read_text(scratch.path() / "err")};
}

/// Every file of a folder and what it holds, except those that tell times.
inline std::vector<std::pair<std::string, std::string>> timeless_files(const std::filesystem::path& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name != "timing.json" && name != "log.txt") files.emplace_back(name, read_text(entry.path()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace strataflow::support
