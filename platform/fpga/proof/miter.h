#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fpga/proof/contract.h>
#include <fpga/proof/links.h>

namespace platform::proof {

/// A port of a module as Yosys elaborated it.
struct Port {
  std::string name;
  unsigned bits;
  bool output;
  std::string place;  ///< "own.sv:12"
};

/// Of the only module in a file of Yosys' write_json. Throws vp::InputError with the place of an
/// inout.
std::vector<Port> read_ports(const std::filesystem::path& file);
/// Throws vp::InputError with the place of what a proof cannot follow: a register or memory that
/// something else moves than the rising edge of the port `clock`.
void check_clock(const std::filesystem::path& file, const std::string& clock);
/// "input logic [3:0] x".
std::string declaration_of(const Port& port);

/// Both modules side by side, as Verilog: module `miter` with the inputs of ours and an output
/// `bad`, which is high on a clock on which something differs that the contract looks at, while the
/// inputs were what it says.
class Miter {
 public:
  static constexpr const char *ours = "ours", *theirs = "theirs";  ///< the modules, and instances

  /// Throws vp::InputError for a port that is missing, of another width or direction, or that ours
  /// does not have: place, name, and what is expected.
  Miter(const Contract& contract, const synthesis::Parameters& parameters,
        const std::vector<Port>& ours, const std::vector<Port>& theirs);
  /// Ours alone: `bad` is a broken rule of one of its streams, and `broken` says which.
  Miter(const Contract& contract, const synthesis::Parameters& parameters,
        const std::vector<Port>& ours);

  /// RTL alone: `bad` is a broken rule of one of its links. Its inputs are `in_NAME`.
  Miter(const std::vector<Port>& ports, const Pins& pins);
  static constexpr const char* input_prefix = "in_";

  const std::string& verilog() const { return verilog_; }
  /// The inputs but the clock, as `miter` has them.
  const std::vector<Port>& inputs() const { return inputs_; }
  /// What is compared; of ours alone the rules. There are nets ours_NAME and theirs_NAME, and
  /// differs_NAME.
  const std::vector<std::string>& compared() const { return compared_; }
  /// Outputs that theirs lacks, or that mean nothing with these parameters.
  const std::vector<std::string>& not_compared() const { return not_compared_; }

 private:
  void declare(const std::vector<Port>& ours);
  void instance(const char* side, const std::vector<Port>& ports);
  void assume(const std::vector<Port>& ours);
  void assume_frames(const std::vector<Port>& ours);
  void compare(const Port& mine, unsigned bits);
  void look_at_rules(const std::vector<Port>& ours);
  void differ(const std::string& name, const std::string& when);
  void end();
  std::string placed(const std::string& input) const;
  std::string resets() const;
  bool is_idle_lane(const std::string& port) const;

  static const Contract& nothing();

  const Contract& contract_;
  const synthesis::Parameters parameters_ = {};
  std::string verilog_;
  std::vector<Port> inputs_;
  std::vector<std::string> compared_, not_compared_;
};

}  // namespace platform::proof
