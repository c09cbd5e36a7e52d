#pragma once

#include <chip/block_design/block_design.h>
#include <chip/system/zynq.h>
#include <simulation.h>
#include <vp/configuration.h>
#include <vp/file.h>
#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "small_handoff.h"
#include "temporary_files.h"

namespace kit {

/// A chip with a design of this text, and `settings` of the user.
struct BuiltDesign : Simulation {
  explicit BuiltDesign(const std::string& text, const std::vector<std::string>& settings = {}) {
    const TemporaryFolder folder;
    const std::string file = folder / "design.yaml";
    vp::write_file(file, text);
    info = platform::block_design::load(file);
    for (const std::string& setting : settings) configuration.set(setting);
    for (const auto& [path, value] : info.defaults) {
      if (!configuration.find(path)) configuration.set(path, value, file);
    }
    const vp::Configuration::Scope scope(configuration);
    zynq = std::make_unique<platform::Zynq>(info);
  }

  template <class T>
  T& part(const std::string& name) {
    auto* object = sc_core::sc_find_object(("pl." + name).c_str());
    BOOST_TEST_REQUIRE(object != nullptr, name);
    return dynamic_cast<T&>(*object);
  }

  /// What software does to a register.
  static void write(vp::RegisterBank& bank, std::uint32_t offset, std::uint32_t word) {
    bank.access(bank[offset], false, offset, word);
  }
  static std::uint32_t read(vp::RegisterBank& bank, std::uint32_t offset) {
    std::uint32_t word = 0;
    bank.access(bank[offset], true, offset, word);
    return word;
  }
  /// Simulated time passes.
  static void pass_us(double us) { sc_core::sc_start(sc_core::sc_time(us, sc_core::SC_US)); }

  vp::Configuration configuration;
  platform::DesignInfo info;
  std::unique_ptr<platform::Zynq> zynq;
};

}  // namespace kit
