#include <fpga/synthesis/path_timing.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include <host/document.h>
#include <host/process.h>
#include <vp/error.h>

namespace platform::synthesis {

namespace {

using Json = nlohmann::json;

constexpr double ns_per_us = 1e3;
constexpr double longest_ns = 100;
constexpr double highest_mhz = 2000;

constexpr const char* net_names[] = {"per_net_ns",    "fan_out_ns", "slack_share",
                                     "most_slack_ns", "tight",      "low",
                                     "high",          "skew_ns",    "uncertainty_ns"};
constexpr const char* cell_names[] = {
    "lut",         "muxf7",       "muxf8",       "carry_enter", "carry_cross",  "carry_ripple",
    "carry_leave", "carry_start", "ff_out",      "ff_data",     "ff_enable",    "ff_reset",
    "bram_out",    "bram_setup",  "lutram_out",  "lutram_read", "lutram_setup", "shift_out",
    "shift_setup", "dsp_out",     "dsp_through", "dsp_setup"};

constexpr const char* limit_names[] = {"global_buffer",   "regional_buffer", "bram",
                                       "bram_read_first", "bram_cascaded",   "dsp",
                                       "dsp_without_mreg"};

/// The numbers of a section: between -`most` and `most`, which `of` says with the unit.
template <std::size_t count>
std::map<std::string, double> numbers(const Json& json, const std::string& key,
                                      const char* const (&names)[count], const std::string& what,
                                      double most = longest_ns, const char* of = "ns up to 100") {
  const auto section = json.find(key);
  if (section == json.end() || !section->is_object()) {
    throw vp::InputError(what + ": '" + key + "' is missing");
  }
  std::map<std::string, double> found;
  for (const char* const word : names) {
    const std::string name(word);
    const auto number = section->find(name);
    if (number == section->end() || !number->is_number() ||
        std::abs(number->get<double>()) > most) {
      throw vp::InputError(what + ": '" + key + "." + name + "' is to be a number of " + of);
    }
    found[name] = *number;
  }
  return found;
}

}  // namespace

PathTiming PathTiming::installed() {
  for (const std::string& folder : host::library_folders()) {
    const std::filesystem::path file = std::filesystem::path(folder) / "rtl" / "xc7.json";
    if (std::filesystem::exists(file)) return load(file);
  }
  throw vp::InputError("no rtl/xc7.json is installed in " + host::library_folders().front() +
                       "; install markervp completely");
}

PathTiming PathTiming::load(const std::filesystem::path& file) {
  const std::string what = "timing file '" + file.string() + "'";
  const Json json = host::read_json<Json>(file, "timing file");
  if (!json.is_object()) throw vp::InputError(what + ": it is not a JSON object");
  PathTiming timing;
  timing.nets_ = numbers(json, "nets", net_names, what);
  timing.cells_ = numbers(json, "cells_ns", cell_names, what);
  timing.limits_ = numbers(json, "limits_mhz", limit_names, what, highest_mhz, "MHz up to 2000");
  for (const auto& [name, mhz] : timing.limits_) {
    if (mhz <= 0)
      throw vp::InputError(what + ": 'limits_mhz." + name + "' is to be a number of MHz above 0");
  }
  const auto between = [&](const char* name, double least, double most) {
    const double value = timing.nets_.at(name);
    if (value < least || value > most) {
      throw vp::InputError(what + ": 'nets." + name + "' is " + std::to_string(value) +
                           ", give one from " + std::to_string(least) + " to " +
                           std::to_string(most));
    }
  };
  between("slack_share", 0, 0.9);
  between("low", 0.1, 1);
  between("high", 1, 10);
  between("tight", 1, timing.nets_.at("high"));
  between("per_net_ns", 0, longest_ns);
  between("fan_out_ns", 0, longest_ns);
  return timing;
}

double PathTiming::operator[](const std::string& name) const {
  const auto found = cells_.find(name);
  if (found == cells_.end()) throw std::logic_error("no delay '" + name + "'");
  return found->second;
}

double PathTiming::limit_mhz(const std::string& name) const {
  const auto found = limits_.find(name);
  if (found == limits_.end()) throw std::logic_error("no limit '" + name + "'");
  return found->second;
}

// The nets take `base` and a share of the time that the cells leave to them. Where the clock leaves
// no other, that is what they take themselves; of one net it is never more than `most_slack_ns`.
double PathTiming::nets_ns(unsigned nets, unsigned fan_out) const {
  const double base = nets_.at("per_net_ns") * std::max(1u, nets) +
                      nets_.at("fan_out_ns") * (std::cbrt(std::max(1u, fan_out)) - 1);
  const double share = nets_.at("slack_share");
  return std::min(base / (1 - share),
                  base + share * nets_.at("most_slack_ns") * std::max(1u, nets));
}

double PathTiming::period_ns(const Path& path, double factor) const {
  return factor * (path.cells_ns + nets_ns(path.nets, path.fan_out)) + path.setup_ns +
         nets_.at("uncertainty_ns") - nets_.at("skew_ns");
}

// Designs that are clocked without anything to spare have longer nets than the model says.
FmaxRange PathTiming::fmax(const Path& path) const {
  const auto mhz = [&](const char* factor) {
    return ns_per_us / period_ns(path, nets_.at(factor));
  };
  return {mhz("high"), mhz("tight"), mhz("low")};
}

}  // namespace platform::synthesis
