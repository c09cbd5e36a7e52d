#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// A design that is data: parts by their VLNV, and how they are wired.
namespace platform::block_design {

/// What a part of a design is in the platform.
enum class Kind {
  model,     ///< a model of the IP
  bus,       ///< a way between masters and slaves: interconnects and converters
  wiring,    ///< a function of wires without a clock
  left_out,  ///< it changes nothing that software sees: logic analysers and the like
  rtl,       ///< the user's RTL, Verilated
  stub,      ///< neither model nor RTL: it answers with zeros
};

/// "model", "bus", "wiring", "left out", "RTL", "stub".
const char* to_string(Kind kind);

/// A parameter of an IP that the platform's stand-in depends on.
struct ParameterRule {
  std::string name;                       ///< as the vendor writes it; capitals do not count
  std::string usual;                      ///< its value where the design says nothing
  std::vector<std::string> allowed = {};  ///< values that are modelled; empty: any number
  std::uint64_t least = 0, most = 0;      ///< of a number; 0 and 0: any
  /// The parameter of the platform that it is, below the part: "fifo.depth"; empty: none, what
  /// places the part reads it.
  std::string sets = {};
};

/// What is known of an IP before it is placed.
struct IpRule {
  std::string ip;  ///< the name in its VLNV: "axi_dma"
  Kind kind;
  std::string what;  ///< for people: "AXI DMA, direct and scatter-gather (PG021)"
  std::vector<ParameterRule> parameters = {};
  std::string maker = {};  ///< vendor and library, "me.org:user"; empty: those of the vendor's IP
};

/// All IP that the platform and its application (own_ip.h) know, by name.
const std::vector<IpRule>& shelf();

/// Parts of the shelf: the rules of IP of streams, and of video.
std::vector<IpRule> stream_rules();
std::vector<IpRule> video_rules();

/// All of it as a table of Markdown: what each IP is here, and which values of its parameters are
/// modelled where not all are.
std::string shelf_table();

/// Whether the VLNV is one of this IP, in any version.
bool is_of(const IpRule& rule, const std::string& vlnv);
/// The rule for a VLNV; null for an IP that is not on the shelf.
const IpRule* rule_for(const std::string& vlnv);

/// The rule of a parameter; null if the IP has no such one that matters.
const ParameterRule* find_parameter(const IpRule& rule, const std::string& name);

/// Inputs of an IP at which its model takes devices of the board, as a whole.
const std::vector<std::string>& board_inputs(const std::string& ip);
/// Whether a pin of another part may drive one of them all the same: a constant, whose level says
/// nothing, and the line of another UART Lite.
bool may_drive_board_input(const std::string& ip, const std::string& driver,
                           const std::string& pin);

/// Whether the vendor's IP has this output and what the platform has in its place does not. It
/// keeps its idle level then, and a result for which something reads it rests on a stub.
bool lacks_output(const IpRule& rule, const std::string& pin);
/// The idle level of an output that is not modelled, by its name: `_n` at the end is active low.
bool idles_high(const std::string& pin);

/// Whether a value is modelled.
bool is_allowed(const ParameterRule& rule, const std::string& value);
/// What is: "'0' or '1'", "8 to 32".
std::string allowed_values(const ParameterRule& rule);
/// The word without the quotation marks that Vivado leaves around some: "1" with them is 1.
std::string unquoted(std::string word);

}  // namespace platform::block_design
