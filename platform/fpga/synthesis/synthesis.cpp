#include <fpga/synthesis/synthesis.h>

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include <fpga/synthesis/data_files.h>
#include <fpga/synthesis/timing_graph.h>
#include <fpga/synthesis/vhdl.h>
#include <fpga/synthesis/yosys.h>
#include <host/digest.h>
#include <host/document.h>
#include <host/guard.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

namespace platform::synthesis {

namespace {

namespace fs = std::filesystem;

constexpr const char* netlist_file = "netlist.json";

/// What maps logic into LUT. ABC9 knows delays, and crashes on memories with byte enables or with
/// two ports that write (yosys#3384, open since 0.17); ABC does not.
enum class Mapper { abc9, abc };

/// Yosys does not let ports of two clocks read before they write (READ_FIRST), for what one writes
/// while the other reads it is undefined (UG473, Conflict Avoidance). Vivado maps such memories.
enum class BlockRamPorts { usual, read_first };

/// What synth_xilinx does in its step map_memory, but for that.
constexpr const char* read_first_memories =
    "\nmemory_libmap -lib +/xilinx/lutrams_xc5v.txt -lib +/xilinx/brams_xc4v.txt -D HAS_SIZE_36 "
    "-D HAS_CASCADE -D HAS_MIXWIDTH_SDP -logic-cost-rom 0.015625"
    "\ntechmap -map +/xilinx/lutrams_xc5v_map.v\ntechmap -map +/xilinx/brams_xc6v_map.v";

std::string script_of(const Design& design, const std::string& reading, Mapper mapper,
                      BlockRamPorts ports) {
  // Deferred: only the modules that the top needs are elaborated. Yosys numbers what it makes, and
  // ties in the mapping fall by these numbers. The library is read here and not by synth_xilinx,
  // for there each pass goes through all of its 800 cells.
  std::string script =
      "read_verilog -lib -specify +/xilinx/cells_sim.v\n"
      "read_verilog -lib -defer +/xilinx/cells_xtra.v\n" +
      reading;
  script += "\n" + elaboration_of(design) + "\nproc";
  script += std::string("\n") + YosysFolder::check;
  const std::string synthesis = std::string("\nsynth_xilinx -family xc7 -flatten -top ") +
                                design.top + (mapper == Mapper::abc9 ? " -abc9" : "") +
                                (design.dsp ? "" : " -nodsp") + " -run ";
  script += synthesis + (ports == BlockRamPorts::usual ? "prepare:" : "prepare:map_memory");
  if (ports == BlockRamPorts::read_first) script += read_first_memories + synthesis + "map_ffram:";
  return script + "\nwrite_json " + netlist_file + "\n";
}

fs::path rtl_folder() {
  for (const std::string& library : host::library_folders()) {
    for (const char* up : {"../..", "../../.."}) {
      const fs::path folder = fs::path(library) / up / "share/markervp/rtl";
      if (fs::exists(folder)) return fs::canonical(folder);
    }
  }
  throw vp::InputError("no RTL is installed in share/markervp/rtl; install markervp completely");
}

/// What figures are kept of: the defaults, and the parameters on which size or speed depend.
std::vector<std::pair<std::string, Parameters>> own_variants() {
  return {{"axi_image_store", {}},
          {"axi_threshold_bridge", {{"FIFO_DEPTH", 64}}},
          {"axi_threshold_bridge", {{"FIFO_DEPTH", 256}}},
          {"axi_threshold_bridge", {{"FIFO_DEPTH", 512}}},
          {"blob_detection", {{"LABELS", 16}}},
          {"blob_detection", {{"LABELS", 64}}},
          {"blob_detection", {{"LABELS", 128}}},
          {"blob_labelling", {{"LABELS", 128}, {"PIXELS_PER_CLOCK", 1}, {"WIDTH", 640}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 1}, {"WIDTH", 640}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 1}, {"WIDTH", 1280}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 2}, {"WIDTH", 640}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 2}, {"WIDTH", 1280}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 4}, {"WIDTH", 640}}},
          {"blob_labelling", {{"LABELS", 512}, {"PIXELS_PER_CLOCK", 4}, {"WIDTH", 1280}}},
          {"blob_stream", {{"CHECKSUM", 0}, {"FIFO_DEPTH", 64}}},
          {"blob_stream", {{"CHECKSUM", 0}, {"FIFO_DEPTH", 512}}},
          {"blob_stream", {{"CHECKSUM", 1}, {"FIFO_DEPTH", 64}}},
          {"blob_stream", {{"CHECKSUM", 1}, {"FIFO_DEPTH", 512}}},
          {"camera", {{"PIXELS_PER_CLOCK", 1}}},
          {"camera", {{"PIXELS_PER_CLOCK", 2}}},
          {"camera", {{"PIXELS_PER_CLOCK", 4}}},
          {"clock_crossing", {}},
          {"control_block", {}},
          {"control_crossing", {}},
          {"corner_detection", {{"LEAN", 0}}},
          {"corner_detection", {{"LEAN", 1}}},
          {"feature_packaging", {{"BUFFER_DEPTH", 16}}},
          {"feature_packaging", {{"BUFFER_DEPTH", 100}}},
          {"feature_packaging", {{"BUFFER_DEPTH", 256}}},
          {"frame_status", {}},
          {"global_threshold", {{"PIXELS_PER_CLOCK", 1}}},
          {"global_threshold", {{"PIXELS_PER_CLOCK", 2}}},
          {"global_threshold", {{"PIXELS_PER_CLOCK", 4}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 1}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 1}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 5}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 5}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 15}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 15}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 31}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 1}, {"RADIUS", 31}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 2}, {"RADIUS", 5}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 2}, {"RADIUS", 5}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 2}, {"RADIUS", 31}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 2}, {"RADIUS", 31}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 4}, {"RADIUS", 5}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 4}, {"RADIUS", 5}, {"RELATIVE", 3}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 4}, {"RADIUS", 31}, {"RELATIVE", 0}}},
          {"local_threshold", {{"PIXELS_PER_CLOCK", 4}, {"RADIUS", 31}, {"RELATIVE", 3}}},
          {"otsu_threshold", {{"PIXELS_PER_CLOCK", 1}}},
          {"otsu_threshold", {{"PIXELS_PER_CLOCK", 2}}},
          {"otsu_threshold", {{"PIXELS_PER_CLOCK", 4}}},
          {"pixel_stream", {{"FIFO_DEPTH", 64}, {"PIXELS_PER_CLOCK", 1}}},
          {"pixel_stream", {{"FIFO_DEPTH", 512}, {"PIXELS_PER_CLOCK", 1}}},
          {"pixel_stream", {{"FIFO_DEPTH", 64}, {"PIXELS_PER_CLOCK", 2}}},
          {"pixel_stream", {{"FIFO_DEPTH", 64}, {"PIXELS_PER_CLOCK", 4}}},
          {"sensor_input", {}},
          {"stream_crossing", {{"DEPTH", 16}}},
          {"stream_crossing", {{"DEPTH", 64}}},
          {"stream_crossing", {{"DEPTH", 256}}}};
}

/// The sources that the top needs, what those include, and what they read into memories.
std::map<std::string, std::string> hashes_of(const Design& design) {
  static const std::regex include(R"re(`include\s+"([^"]+)")re");
  std::vector<fs::path> open = needed_by(design.top, design.sources);
  std::map<std::string, std::string> hashes;
  while (!open.empty()) {
    const fs::path source = open.back();
    open.pop_back();
    const bool fresh =
        hashes.emplace(source.filename().string(), host::file_hash(source.string())).second;
    if (!fresh) continue;
    const std::string text = vp::read_text(source.string(), "source");
    for (std::sregex_iterator m(text.begin(), text.end(), include), end; m != end; ++m) {
      std::vector<fs::path> folders{source.parent_path()};
      folders.insert(folders.end(), design.includes.begin(), design.includes.end());
      for (const fs::path& folder : folders) {
        if (!fs::exists(folder / (*m)[1].str())) continue;
        open.push_back(folder / (*m)[1].str());
        break;
      }
    }
  }
  for (const auto& [name, file] : data_files_of(design))
    hashes.emplace(file.filename().string(), host::file_hash(file.string()));
  return hashes;
}

}  // namespace

std::vector<Design> own_designs(const std::vector<std::string>& only) {
  const std::vector<fs::path> sources = sources_in(rtl_folder());
  std::vector<std::string> names;
  std::vector<Design> designs;
  for (const auto& [ip, parameters] : own_variants()) {
    if (std::find(names.begin(), names.end(), ip) == names.end()) names.push_back(ip);
    if (only.empty() || std::find(only.begin(), only.end(), ip) != only.end()) {
      designs.push_back({ip, ip, needed_by(ip, sources), parameters, true, true});
    }
  }
  for (const std::string& name : only) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw vp::InputError("no RTL of an IP '" + name + "': name " + vp::one_of(names) +
                           ", or give your own with --rtl and --top");
    }
  }
  return designs;
}

namespace {

/// Yosys stopped without a word about an error.
bool crashed(const host::CommandEnd& end) {
  return end.exit_code != 0 && end.exit_code != host::no_such_command &&
         end.out.find("ERROR: ") == std::string::npos;
}

}  // namespace

Figures synthesise(const Design& design, const PathTiming& timing) {
  if (is_of_vhdl(design)) {
    const host::ScratchFolder folder("vhdl");
    Figures figures = synthesise(verilog_of(design, folder.path()), timing);
    figures.parameters = design.parameters;
    figures.sources = hashes_of(design);
    return figures;
  }
  YosysFolder yosys(design);
  BlockRamPorts ports = BlockRamPorts::usual;
  const auto run = [&](Mapper mapper) {
    return yosys.run(
        [&](const std::string& reading) { return script_of(design, reading, mapper, ports); });
  };
  host::CommandEnd end = run(Mapper::abc9);
  if (end.out.find("no valid mapping found for memory") != std::string::npos) {
    ports = BlockRamPorts::read_first;
    end = run(Mapper::abc9);
  }
  const bool fell_back = crashed(end);
  if (fell_back) end = run(Mapper::abc);
  if (end.exit_code != 0) {
    yosys.refuse_loops();
    yosys.refuse(end);
  }
  try {
    Figures figures{design.ip, design.parameters, hashes_of(design),
                    read_netlist(yosys / netlist_file, design.top, timing), design.own};
    if (fell_back) {
      figures.netlist.not_covered.push_back(
          "ABC9 fails on a memory of this RTL (yosys#3384), so ABC mapped the logic, without "
          "delays: "
          "what the other would make shorter");
    }
    return figures;
  } catch (const LoopError& error) {
    yosys.refuse_loops();  // knows the line
    refuse(design, error.what());
  } catch (const vp::InputError& error) {
    std::string why = error.what();
    yosys.name_originals(why);
    refuse(design, why);
  }
}

}  // namespace platform::synthesis
