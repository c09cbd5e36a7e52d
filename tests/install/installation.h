#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "child_process.h"

namespace install_test {

using Words = std::vector<std::string>;

/// markervp, installed once for all tests of the process into a temporary folder, and moved from
/// there: nothing may depend on where it was installed.
class Installation {
 public:
  static const Installation& get();

  /// A file or folder below the prefix.
  std::string operator/(const std::string& path) const { return folder_ / ("prefix/" + path); }
  /// A folder beside the prefix, for what is built against it.
  std::string beside(const std::string& name) const { return folder_ / name; }

  /// Runs the installed executable in the folder that holds the prefix.
  kit::Outcome markervp(const Words& arguments) const;
  kit::Outcome run(const std::string& program, const Words& arguments) const;
  /// The result of `markervp run` with `more`, in the folder beside(`name`). It works, in silence.
  nlohmann::ordered_json result(const std::string& name, const Words& more) const;

  /// Configures the project in `source`, in beside(`name`). Does not care how that ends.
  kit::Outcome configure(const std::string& source, const std::string& name,
                         const Words& more = {}) const;
  /// Configures and builds it; throws with the output if that fails. Done once for each name.
  void build(const std::string& source, const std::string& name) const;
  kit::Outcome build_target(const std::string& name, const std::string& target) const;

 private:
  Installation();

  kit::TemporaryFolder folder_;
};

/// Source folder of a project of these tests.
std::string project(const std::string& name);

bool contains(const std::string& text, const std::string& part);

/// Checks that it is one line on stderr, with all of `parts`, and nothing on stdout.
void check_refused(const kit::Outcome& outcome, const Words& parts);

}  // namespace install_test
