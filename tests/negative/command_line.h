#pragma once

#include <string>
#include <vector>

#include "child_process.h"

namespace negative {

using Words = std::vector<std::string>;

/// A folder in which the executable runs, and the checks that all refusals share.
class CommandLine : public kit::TemporaryFolder {
 public:
  kit::Outcome start(const Words& arguments) const;

  /// Runs a line of bash in which "$markervp" is the executable.
  kit::Outcome shell(const std::string& line) const;

  /// Runs `markervp`, which must refuse: exit code 2, nothing on stdout, one line on stderr that
  /// has all of `parts`, and not a file made, changed or removed.
  void refuses(const Words& arguments, const Words& parts) const;

  /// The same for `markervp run` with the option --output out.
  void run_refuses(const Words& arguments, const Words& parts) const;

  /// Writes a grey image of 640x480 as PGM.
  void write_image(const std::string& name) const;
};

/// Checks that `text` is one line from markervp that has all of `parts`.
void check_one_line(const std::string& text, const Words& parts);

bool contains(const std::string& text, const std::string& part);

}  // namespace negative
