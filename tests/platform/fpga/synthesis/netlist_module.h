#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include <fpga/synthesis/netlist.h>
#include <vp/error.h>

#include "temporary_files.h"

namespace kit {

using Json = nlohmann::ordered_json;

inline const platform::synthesis::PathTiming timing =
    platform::synthesis::PathTiming::load(std::string(MARKERVP_DATA) + "/rtl/xc7.json");

/// A module `top` that grows cell by cell. Bits are numbers from 2.
struct Module {
  Json cells = Json::object(), names = Json::object();

  void add(const std::string& type, const Json& inputs, const Json& outputs) {
    Json directions = Json::object(), ports = Json::object();
    for (const auto& [port, bits] : inputs.items()) {
      directions[port] = "input";
      ports[port] = bits;
    }
    for (const auto& [port, bits] : outputs.items()) {
      directions[port] = "output";
      ports[port] = bits;
    }
    cells["$" + std::to_string(cells.size())] = {{"type", type},
                                                 {"parameters", Json::object()},
                                                 {"port_directions", directions},
                                                 {"connections", ports}};
  }
  void flip_flop(int d, int q, int clock = 1) {
    add("FDRE", {{"C", {clock}}, {"D", {d}}}, {{"Q", {q}}});
  }
  void lut(int in, int out) { add("LUT1", {{"I0", {in}}}, {{"O", {out}}}); }
  void name(int bit, const std::string& as) { names[as] = {{"bits", {bit}}}; }

  platform::synthesis::Netlist read() const {
    const TemporaryFolder folder;
    const Json json{{"modules", {{"top", {{"cells", cells}, {"netnames", names}}}}}};
    write_file(folder / "netlist.json", json.dump());
    return platform::synthesis::read_netlist(folder / "netlist.json", "top", timing);
  }
  std::string refusal() const {
    try {
      read();
    } catch (const vp::InputError& error) {
      return error.what();
    }
    return "";
  }
};

}  // namespace kit
