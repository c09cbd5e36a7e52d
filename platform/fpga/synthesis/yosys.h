#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fpga/synthesis/rtl_design.h>
#include <host/guard.h>
#include <host/process.h>

/// Yosys, and RTL as it reads it.
namespace platform::synthesis {

/// What Yosys calls itself: "Yosys 0.23". Throws vp::InputError if it is not installed.
std::string yosys_version();

/// Of one design: a folder in which Yosys runs and leaves its files. It goes with this object.
class YosysFolder {
 public:
  /// A script, made of the command that reads the design's sources.
  using Script = std::function<std::string(const std::string& reading)>;

  /// Throws vp::InputError for names that Verilog does not know.
  explicit YosysFolder(const Design& design);

  /// Runs Yosys, once more where it stumbles over what is legal. What it prints names the design's
  /// own files. It is ended behind so many seconds of the processor, if there are any.
  host::CommandEnd run(const Script& script, unsigned seconds = 0);

  std::filesystem::path operator/(const std::string& name) const { return scratch_ / name; }

  /// In a text of Yosys' the design's own files instead of links and copies.
  void name_originals(std::string& text) const;

  /// The command of a script behind which refuse_loops() knows of combinational loops: between
  /// whole words, which need not be loops of bits.
  static constexpr const char* check = "tee -q -o check.txt check";
  /// Throws vp::InputError with file and line if there is one.
  void refuse_loops() const;

  /// Throws vp::InputError for what Yosys says of an error, in our words where we know better.
  [[noreturn]] void refuse(const host::CommandEnd& end) const;

 private:
  host::CommandEnd run_script(const Script& script, unsigned seconds) const;
  std::string reading() const;
  void link_data() const;
  bool read_only_what_is_needed();
  void copy_without_simulation();
  void refuse_endings() const;
  std::string line_at(const std::string& place) const;
  /// "file:line: " of the first line with both, of those that declare the module if there is one
  /// in them; "" without one.
  std::string place_of(const std::string& word, const std::string& name,
                       const std::string& module) const;

  const Design& design_;
  const host::ScratchFolder scratch_{"synth"};
  const std::vector<std::filesystem::path> includes_;  ///< each has a link in the folder
  std::vector<std::filesystem::path> originals_;       ///< the design's, or those that it needs
  std::vector<std::filesystem::path> sources_;         ///< these, or copies of them
};

/// The commands that make the top with its parameters of what was read. The top's name stays.
std::string elaboration_of(const Design& design);

/// A command in a folder, and what it printed: Yosys and ABC give names to a shell unquoted, and in
/// their own folder they have no spaces. `seconds` as YosysFolder::run().
host::CommandEnd run_in(const std::filesystem::path& folder,
                        const std::vector<std::string>& command, unsigned seconds = 0);

/// Throws vp::InputError that names the design: why it cannot be synthesised.
[[noreturn]] void refuse(const Design& design, const std::string& why);

}  // namespace platform::synthesis
