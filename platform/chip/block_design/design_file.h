#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <chip/block_design/shelf.h>

namespace platform::block_design {

/// An end of a wire or a bus: "axi_dma_0.M_AXIS_MM2S"; `part` is "external" for a pin of the chip.
struct End {
  std::string part;
  std::string port;
  std::string place;  ///< file and line, for messages

  std::string text() const { return part + "." + port; }
};

/// How a part is placed.
struct PlacedPart {
  std::string name;
  std::string vlnv;
  std::string as;   ///< "stub": not its model; "": what the shelf says
  std::string rtl;  ///< Verilated RTL in its place, relative to the design's file; "": none
  /// Why the build of the folder refused its RTL, so that it is a stub; "": it did not.
  std::string refused;
  std::string place;  ///< file and line
  std::map<std::string, std::string> parameters;
  std::map<std::string, std::uint64_t> clocks;  ///< of a stub or RTL: frequency of an output, Hz
  std::map<std::string, End> pins;              ///< input: what drives it
  std::map<std::string, End> buses;             ///< slave: its master

  /// The rule of the shelf that it is placed by; null for a stub and for RTL.
  const IpRule* rule() const;
  bool is_stub() const { return as == "stub" || (rtl.empty() && !rule()); }
};

/// Where a master sees a slave.
struct AddressSegment {
  End master;
  End slave;
  std::uint64_t base = 0, size = 0;
};

/// A pin of the chip.
struct ExternalPin {
  std::string name;
  std::string place;
  unsigned width = 1;
  std::uint64_t level = 0;  ///< of an input
  std::uint64_t hz = 0;     ///< of an input that is a clock; 0: a level
};

/// What a design delivers, and how the end of a unit of it is seen: a pin rises, the program prints
/// a line with a text, or, with neither, the program publishes something (hal_publish).
struct UnitOfWork {
  std::string name;  ///< "packet"; empty: it delivers nothing
  std::string line;
  End end;  ///< a part of "": no pin
};

/// A block design as its YAML file describes it.
struct DesignFile {
  std::string file;
  std::string name;
  std::vector<std::string> programs;  ///< of the PS, relative to the file
  /// Parameters of the platform, unless the user sets others: {"ps.cpu_clk.frequency", "650 MHz"}.
  std::vector<std::pair<std::string, std::string>> settings;
  UnitOfWork unit;
  std::vector<PlacedPart> parts;
  std::vector<AddressSegment> addresses;
  std::vector<ExternalPin> external;

  /// The part of that name, or null.
  const PlacedPart* part(const std::string& wanted) const;
  const ExternalPin* pin(const std::string& wanted) const;

  std::map<std::string, std::size_t> part_index = {};  ///< places in `parts`, by name
};

/// Reads one. Throws vp::InputError with file, line and the nearest name for what is unknown, twice
/// there, or does not fit together.
DesignFile read_design_file(const std::string& file);
/// The same for its text.
DesignFile parse_design(const std::string& text, const std::string& origin);

/// Whether a file's name is that of a design in YAML.
bool is_design_yaml(const std::string& file);

}  // namespace platform::block_design
