#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <chip/block_design/memory_file.h>
#include <chip/block_design/place_ports.h>
#include <vp/error.h>
#include <vp/file.h>
#include <xilinx/axi_bram_ctrl/axi_bram_ctrl.h>
#include <xilinx/blk_mem_gen/blk_mem_gen.h>

// Block memory with native ports, and the controllers that let software see it.
namespace platform::block_design {

/// Its memory is as large as the segment in which it is seen.
Placed place_bram_ctrl(const Placement& at) {
  xilinx::AxiBramCtrlBuild build;
  build.axi4_lite = at.text("C_S_AXI_PROTOCOL") == "AXI4LITE";
  build.single_port = at.flag("C_SINGLE_PORT_BRAM");
  constexpr std::uint32_t bits_of_byte = 8;
  build.data_bytes = word(at, "C_S_AXI_DATA_WIDTH") / bits_of_byte;
  for (const AddressSegment& segment : at.design.addresses) {
    if (segment.slave.part == at.part.name)
      build.memory_size =
          static_cast<std::uint32_t>(std::min<std::uint64_t>(segment.size, 1u << 30));
  }
  auto memory =
      std::make_unique<xilinx::AxiBramCtrl>(at.part.name.c_str(), at.clock({"s_axi_aclk"}), build);
  Placed placed;
  xilinx::AxiBramCtrl* target = memory.get();
  placed.slaves = {{"S_AXI", {[target](RegionSocket& socket) { socket.bind(target->s_axi); }}}};
  placed.inputs = {{"s_axi_aresetn", input(at, "s_axi_aresetn", memory->s_axi_aresetn)}};
  placed.unused_inputs = {"bram_rddata_a", "bram_rddata_b"};  // of the memory, which is part of it
  placed.controller = target;
  placed.object = std::move(memory);
  return placed;
}

namespace {

constexpr const char* port_pins[] = {"clk", "rst", "en", "regce", "we", "addr", "din"};

/// The part that drives a port of a memory; null: nothing does.
const PlacedPart* driver_of(const DesignFile& design, const PlacedPart& memory, char port) {
  for (const char* pin : {"addr", "clk"}) {
    const auto source = memory.pins.find(pin + std::string(1, port));
    if (source != memory.pins.end()) return design.part(source->second.part);
  }
  return nullptr;
}

bool is_controller(const PlacedPart* part) {
  const IpRule* rule = part && !part->is_stub() && part->rtl.empty() ? part->rule() : nullptr;
  return rule && rule->ip == "axi_bram_ctrl";
}

/// The clock of a port: that of its pin, or, where logic passes its own on, the logic's.
vp::Clock& clock_of_port(const Placement& at, char port) {
  const std::string pin = std::string("clk") + port;
  const auto source = at.part.pins.find(pin);
  if (source == at.part.pins.end()) return at.clock({pin});
  if (vp::Clock* clock = at.clock_at(pin)) return *clock;
  const PlacedPart* driver = at.design.part(source->second.part);
  if (!driver) return at.ports.fclk_clk(0);  // a level at a pin of the chip: the port rests
  vp::Clock* own = nullptr;
  for (const auto& [name, end] : driver->pins) {
    vp::Clock* clock = at.clock_of(end);
    if (clock && own && clock != own)
      at.refuse("its pin " + pin + " is driven by " + source->second.text() + ", and " +
                driver->name + " has several clocks: say which frequency it has, 'clocks: {" +
                source->second.port + ": 100 MHz}' of " + driver->name);
    if (clock) own = clock;
  }
  return own ? *own : at.clock({pin});
}

/// Of a memory that controllers alone reach, or nothing.
vp::Clock& clock_of_controller(const Placement& at) {
  for (const PlacedPart* controller : controllers_of(at.design, at.part)) {
    const auto pin = controller->pins.find("s_axi_aclk");
    vp::Clock* clock = pin == controller->pins.end() ? nullptr : at.clock_of(pin->second);
    if (clock) return *clock;
  }
  return at.ports.fclk_clk(0);
}

struct PortKind {
  bool writes, reads;
};

/// Of C_MEM_TYPE: single-port RAM, simple and true dual-port RAM, ROM with one port and with two.
PortKind kind_of_port(std::uint64_t type, char port) {
  constexpr std::uint64_t simple_dual = 1, first_rom = 3;
  if (type >= first_rom) return {false, true};
  if (type == simple_dual) return {port == 'a', port == 'b'};
  return {true, true};
}

xilinx::BlkMemPortBuild port_build(const Placement& at, char port) {
  using WriteMode = xilinx::BlkMemPortBuild::WriteMode;
  const std::string end(1, static_cast<char>(port - 'a' + 'A'));
  const PortKind kind = kind_of_port(at.number("C_MEM_TYPE"), port);
  const std::string of = kind.writes ? "C_WRITE_" : "C_READ_";
  xilinx::BlkMemPortBuild build;
  build.writes = kind.writes;
  build.reads = kind.reads;
  build.width = word(at, of + "WIDTH_" + end);
  build.depth = word(at, of + "DEPTH_" + end);
  if (kind.writes && kind.reads && word(at, "C_READ_WIDTH_" + end) != build.width)
    at.refuse("its port " + end + " reads other widths than it writes, which is not modelled");
  if (at.flag("C_USE_BYTE_WE" + end)) build.lane_bits = word(at, "C_BYTE_SIZE");
  build.byte_addresses = at.flag("C_USE_BRAM_BLOCK");
  build.has_enable = at.flag("C_HAS_EN" + end);
  build.latency =
      1 + word(at, "C_HAS_MEM_OUTPUT_REGS_" + end) + word(at, "C_HAS_MUX_OUTPUT_REGS_" + end);
  build.reset_value = hex_number(at.text("C_INIT" + end + "_VAL"));
  const std::string mode = at.text("C_WRITE_MODE_" + end);
  if (mode == "READ_FIRST") build.write_mode = WriteMode::read_first;
  if (mode == "NO_CHANGE") build.write_mode = WriteMode::no_change;
  return build;
}

/// What it has at its start.
std::vector<std::uint64_t> contents(const Placement& at, std::uint64_t depth) {
  const std::uint64_t rest =
      at.flag("C_USE_DEFAULT_DATA") ? hex_number(at.text("C_DEFAULT_DATA")) : 0;
  std::vector<std::uint64_t> words;
  if (at.flag("C_LOAD_INIT_FILE")) {
    namespace fs = std::filesystem;
    const fs::path file = fs::path(at.design.file).parent_path() / at.text("Coe_File");
    words = read_memory_file(vp::read_text(file, "contents of a memory"), file.string());
  }
  if (words.size() > depth)
    at.refuse("its file has " + std::to_string(words.size()) + " words, and it has " +
              std::to_string(depth));
  if (rest != 0) words.resize(depth, rest);
  return words;
}

void name_pins(const Placement& at, xilinx::BlkMemGen::Port& port, char letter, Placed& placed) {
  const auto named = [letter](const char* pin) { return pin + std::string(1, letter); };
  placed.unused_inputs.insert(named("clk"));
  placed.inputs[named("rst")] = input(at, named("rst"), port.rst);
  placed.inputs[named("en")] = input(at, named("en"), port.en);
  placed.inputs[named("regce")] = input(at, named("regce"), port.regce);
  placed.inputs[named("we")] = input(at, named("we"), port.we);
  placed.inputs[named("addr")] = input(at, named("addr"), port.addr);
  placed.inputs[named("din")] = input(at, named("din"), port.din);
  placed.outputs[named("dout")] = &port.dout;
  placed.outputs[std::string("rst") + letter + "_busy"] = &port.rst_busy;
}

}  // namespace

std::vector<const PlacedPart*> controllers_of(const DesignFile& design, const PlacedPart& memory) {
  std::vector<const PlacedPart*> list;
  for (const char port : {'a', 'b'}) {
    const PlacedPart* driver = driver_of(design, memory, port);
    if (is_controller(driver) && std::find(list.begin(), list.end(), driver) == list.end())
      list.push_back(driver);
  }
  return list;
}

Placed place_block_memory(const Placement& at) {
  xilinx::BlkMemGenBuild build;
  std::vector<vp::Clock*> clocks;
  std::vector<char> letters;
  Placed placed;
  for (const char letter : {'a', 'b'}) {
    const PlacedPart* driver = driver_of(at.design, at.part, letter);
    const bool is_open = at.part.pins.count(std::string("addr") + letter) == 0;
    if (is_open || is_controller(driver)) {
      for (const char* pin : port_pins) placed.unused_inputs.insert(pin + std::string(1, letter));
      continue;
    }
    build.ports.push_back(port_build(at, letter));
    clocks.push_back(&clock_of_port(at, letter));
    letters.push_back(letter);
  }
  const bool is_written = kind_of_port(at.number("C_MEM_TYPE"), 'a').writes;
  build.word_bits = word(at, is_written ? "C_WRITE_WIDTH_A" : "C_READ_WIDTH_A");
  build.words = at.number(is_written ? "C_WRITE_DEPTH_A" : "C_READ_DEPTH_A");
  build.contents = contents(at, build.words);
  constexpr double half = 0.5;
  build.bram36 = static_cast<double>(at.number("C_COUNT_36K_BRAM")) +
                 half * static_cast<double>(at.number("C_COUNT_18K_BRAM"));
  if (clocks.empty()) clocks.push_back(&clock_of_controller(at));
  auto memory = std::make_unique<xilinx::BlkMemGen>(at.part.name.c_str(), clocks, build);
  for (std::size_t i = 0; i < letters.size(); ++i)
    name_pins(at, memory->port(i), letters[i], placed);
  placed.memory = memory.get();
  placed.object = std::move(memory);
  return placed;
}

}  // namespace platform::block_design
