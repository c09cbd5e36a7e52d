#pragma once

#include <string>
#include <vector>

#include "child_process.h"

namespace cli_test {

/// Runs the program as a user does, in a folder of its own.
struct Terminal {
  int run(const std::vector<std::string>& arguments) {
    const kit::Outcome outcome = kit::run_process(MARKERVP_EXECUTABLE, arguments, folder.path());
    out = outcome.out;
    err = outcome.err;
    return outcome.exit_code;
  }

  kit::TemporaryFolder folder;
  std::string out, err;  ///< what it printed last
};

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// One line with the program's name, holding `part`.
inline bool is_one_line_with(const std::string& text, const std::string& part) {
  return text.rfind("markervp: ", 0) == 0 && text.find('\n') == text.size() - 1 &&
         contains(text, part);
}

}  // namespace cli_test
