// One description of the registers: headers, models and documentation agree.
#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <chip/block_design/shelf.h>
#include <chip/system/designs.h>
#include <chip/system/hardware_map.h>
#include <cli/commands.h>
#include <devcfg_registers.h>
#include <gem_registers.h>
#include <gic_registers.h>
#include <global_timer_registers.h>
#include <private_timer_registers.h>
#include <ps_gpio_registers.h>
#include <ps_i2c_registers.h>
#include <ps_spi_registers.h>
#include <ps_xadc_registers.h>
#include <qspi_registers.h>
#include <sdio_registers.h>
#include <slcr_registers.h>
#include <system_watchdog_registers.h>
#include <ttc_registers.h>
#include <uart_registers.h>
#include <usb_registers.h>
#include <vp/configuration.h>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "simulation.h"
#include "temporary_files.h"

namespace {

using platform::facts::HardwareMap;
namespace fs = std::filesystem;

struct Description {
  vp::RegisterTable table;
  std::vector<std::string> devices;
};

const std::vector<Description>& descriptions() {
  static const std::vector<Description> list{{axi_dma::registers, {"axi_dma_0", "axi_dma_1"}},
                                             {axi_gpio::registers, {"axi_gpio_0", "axi_gpio_1"}},
                                             {gic::cpu_interface_registers, {"gic_cpu_interface"}},
                                             {gic::distributor_registers, {"gic_distributor"}},
                                             {global_timer::registers, {"global_timer"}},
                                             {private_timer::registers, {"private_timer"}},
                                             {slcr::registers, {"slcr"}},
                                             {uart::registers, {"uart0", "uart1"}},
                                             {ps_gpio::registers, {"gpio"}},
                                             {ps_i2c::registers, {"i2c0", "i2c1"}},
                                             {ps_spi::registers, {"spi0", "spi1"}},
                                             {ttc::registers, {"ttc0", "ttc1"}},
                                             {system_watchdog::registers, {"swdt"}},
                                             {ps_xadc::registers, {"xadc"}},
                                             {devcfg::registers, {"devcfg"}},
                                             {qspi::registers, {"qspi"}},
                                             {sdio::registers, {"sdio0", "sdio1"}},
                                             {gem::registers, {"gem0", "gem1"}},
                                             {usb::registers, {"usb0", "usb1"}}};
  return list;
}

HardwareMap default_map() {
  const kit::Simulation context;
  vp::Configuration configuration;
  const vp::Configuration::Scope scope(configuration);
  platform::Zynq zynq{*platform::builtin_designs().front()};
  return platform::hardware_map(zynq);
}

const HardwareMap::Device* find(const HardwareMap& map, const std::string& name) {
  const auto found = std::find_if(map.devices.begin(), map.devices.end(),
                                  [&](const auto& device) { return device.name == name; });
  return found == map.devices.end() ? nullptr : &*found;
}

const fs::path source{MARKERVP_SOURCE};

}  // namespace

BOOST_AUTO_TEST_SUITE(register_descriptions)

BOOST_AUTO_TEST_CASE(the_documentation_is_what_the_program_prints) {
  const std::string page = kit::read_file(source / "docs/registers.md");
  BOOST_TEST((page == platform::cli::map_as_markdown(default_map())),
             "docs/registers.md is old: markervp map --markdown > docs/registers.md");
}

BOOST_AUTO_TEST_CASE(the_documentation_has_the_shelf_that_the_program_prints) {
  const std::string page = kit::read_file(source / "docs/own-zynq.md");
  BOOST_TEST((page.find(platform::block_design::shelf_table()) != std::string::npos),
             "the table of docs/own-zynq.md is old: markervp import --shelf prints it");
}

BOOST_AUTO_TEST_CASE(what_has_a_model_is_not_among_what_has_none) {
  const std::string page = platform::cli::map_as_markdown(default_map());
  const std::string title = "\n## Blocks of the PS without a model\n";
  const std::size_t from = page.find(title);
  BOOST_TEST_REQUIRE(from != std::string::npos);
  const std::string list = page.substr(from, page.find("\n## ", from + title.size()) - from);
  for (const char* missing : {"0xE000_8000", "0xF800_3000", "0xF800_6000", "0xF8F0_2000"}) {
    BOOST_TEST(list.find(std::string("| ") + missing + " |") != std::string::npos, missing);
  }
  for (const char* there :
       {"0xE000_0000", "0xE000_1000", "0xE000_A000", "0xF800_0000", "0xF800_7100", "0xF8F0_0100",
        "0xF8F0_0200", "0xF8F0_0600", "0xF8F0_1000"}) {
    BOOST_TEST(list.find(std::string("| ") + there + " |") == std::string::npos, there);
  }
}

BOOST_AUTO_TEST_CASE(every_model_has_the_registers_of_its_header) {
  const HardwareMap map = default_map();
  std::size_t with_registers = 0;
  for (const Description& description : descriptions()) {
    for (const std::string& name : description.devices) {
      const HardwareMap::Device* device = find(map, name);
      BOOST_TEST_REQUIRE(device, name << " is not in the map");
      ++with_registers;
      BOOST_TEST_REQUIRE(device->registers.size() == description.table.count);
      for (std::size_t i = 0; i < description.table.count; ++i) {
        const vp::RegisterInfo& info = description.table.first[i];
        const HardwareMap::Register& r = device->registers[i];
        BOOST_TEST(r.name == info.name);
        BOOST_TEST(r.offset == info.offset, info.name);
        BOOST_TEST(r.declared_reset == info.reset, info.name);
        BOOST_TEST(r.writable == info.writable, info.name);
        BOOST_TEST(r.documentation == info.documentation, info.name);
      }
    }
  }
  for (const HardwareMap::Device& device : map.devices) {
    if (!device.registers.empty()) --with_registers;
  }
  BOOST_TEST(with_registers == 0u, "a device of the map has no description here");
}

BOOST_AUTO_TEST_CASE(descriptions_are_sound) {
  for (const Description& description : descriptions()) {
    std::set<std::string> names;
    std::set<std::uint32_t> offsets;
    for (std::size_t i = 0; i < description.table.count; ++i) {
      const vp::RegisterInfo& info = description.table.first[i];
      BOOST_TEST(names.insert(info.name).second, info.name << " is there twice");
      BOOST_TEST(offsets.insert(info.offset).second, info.name << " is on top of another");
      BOOST_TEST(info.offset % 4 == 0u, info.name);
      const std::string text = info.documentation;
      BOOST_TEST(!text.empty(), info.name);
      BOOST_TEST(text.find('\n') == std::string::npos, info.name << ": one line");
      if (info.access == vp::Access::read_only) BOOST_TEST(info.writable == 0u, info.name);
      if (info.access != vp::Access::read_only) BOOST_TEST(info.writable != 0u, info.name);
    }
  }
}

/// What the fields say together is what the register says.
BOOST_AUTO_TEST_CASE(fields_are_sound) {
  std::size_t with_fields = 0;
  for (const Description& description : descriptions()) {
    for (std::size_t i = 0; i < description.table.count; ++i) {
      const vp::RegisterInfo& info = description.table.first[i];
      std::set<std::string> names;
      std::uint32_t used = 0, writable = 0;
      for (const vp::RegisterField& field : info.fields) {
        BOOST_TEST_CONTEXT(info.name << "." << field.name) {
          BOOST_TEST(names.insert(field.name).second, "is there twice");
          BOOST_TEST(field.mask != 0u);
          BOOST_TEST((used & field.mask) == 0u, "is on top of another");
          const std::string text = field.documentation;
          BOOST_TEST(!text.empty());
          BOOST_TEST(text.find('\n') == std::string::npos, "one line");
          used |= field.mask;
          if (field.access != vp::Access::read_only) writable |= field.mask;
          if (info.access == vp::Access::write_only) {
            BOOST_TEST((field.access == vp::Access::write_only));
          }
        }
      }
      BOOST_TEST_CONTEXT(info.name) {
        if (used != 0) {
          ++with_fields;
          BOOST_TEST(writable == info.writable);
          BOOST_TEST((info.reset & ~used) == 0u, "bits outside of fields read 0");
        } else {
          // One field, which the line of the register describes.
          const std::uint32_t lowest = info.writable & (~info.writable + 1);
          BOOST_TEST((info.writable & (info.writable + lowest)) == 0u, "needs fields");
        }
      }
    }
  }
  BOOST_TEST(with_fields > 150u);
}

BOOST_AUTO_TEST_CASE(the_map_shows_fields) {
  const HardwareMap map = default_map();
  const HardwareMap::Register& control = find(map, "axi_dma_0")->registers.front();
  BOOST_TEST_REQUIRE(control.fields.size() == 10u);
  const HardwareMap::Field& threshold = control.fields[8];
  BOOST_TEST(threshold.name == "IRQThreshold");
  BOOST_TEST(threshold.mask == 0x00FF0000u);
  BOOST_TEST(threshold.access == "rw");
  BOOST_TEST(threshold.reset == 1u);
  // The other channel of this core was not built.
  const HardwareMap::Register& absent = find(map, "axi_dma_0")->registers[9];
  BOOST_TEST(absent.fields[8].reset == 0u);
}

/// A row {"NAME", NAME, …} that names another constant than its register would mislead software.
BOOST_AUTO_TEST_CASE(a_row_has_the_name_of_its_constant) {
  const std::regex row{R"re(\{\s*"(\w+)"\s*,\s*(?:\w+::)?([A-Za-z_]\w*)(?:\((\d+)\))?\s*,)re"};
  std::size_t headers = 0, rows = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source / "models")) {
    const std::string file = entry.path().filename().string();
    if (file.size() < 12 || file.rfind("_registers.h") != file.size() - 12) continue;
    ++headers;
    const std::string text = kit::read_file(entry.path());
    for (std::sregex_iterator i(text.begin(), text.end(), row), end; i != end; ++i, ++rows) {
      BOOST_TEST((*i)[1].str() == (*i)[2].str() + (*i)[3].str(), file);
    }
  }
  BOOST_TEST(headers == 29u);
  BOOST_TEST(rows > 150u);
}

BOOST_AUTO_TEST_CASE(the_map_is_that_of_the_configuration) {
  const kit::Simulation context;
  vp::Configuration configuration;
  configuration.set("ps.fclk_clk1.frequency=74.25 MHz");
  configuration.set("clocks=exact");
  configuration.set("ps.ddr.size=383 MiB");
  const vp::Configuration::Scope scope(configuration);
  platform::Zynq zynq{*platform::builtin_designs().front()};
  const HardwareMap map = platform::hardware_map(zynq);
  BOOST_TEST(find(map, "ddr")->size == 383u << 20);
  const auto clock = std::find_if(map.clocks.begin(), map.clocks.end(),
                                  [](const auto& c) { return c.name == "ps.fclk_clk1.clk"; });
  BOOST_TEST(clock->hertz == 74'250'000u);
  BOOST_TEST(clock->programmed == 74'074'074u);
  const HardwareMap::Device& mm2s_only = *find(map, "axi_dma_0");
  BOOST_TEST(mm2s_only.registers.front().built);
  BOOST_TEST(!mm2s_only.registers.back().built);
  const std::map<std::uint32_t, std::string> expected{{27, "ps.global_timer.irq"},
                                                      {29, "ps.private_timer.irq"},
                                                      {30, "ps.private_timer.watchdog_irq"},
                                                      {39, "ps.xadc.irq"},
                                                      {40, "ps.devcfg.irq"},
                                                      {41, "ps.swdt.irq"},
                                                      {42, "ps.ttc0.irq0"},
                                                      {43, "ps.ttc0.irq1"},
                                                      {44, "ps.ttc0.irq2"},
                                                      {51, "ps.qspi.irq"},
                                                      {52, "ps.gpio.irq"},
                                                      {56, "ps.sdio0.irq"},
                                                      {57, "ps.i2c0.irq"},
                                                      {58, "ps.spi0.irq"},
                                                      {69, "ps.ttc1.irq0"},
                                                      {70, "ps.ttc1.irq1"},
                                                      {71, "ps.ttc1.irq2"},
                                                      {79, "ps.sdio1.irq"},
                                                      {80, "ps.i2c1.irq"},
                                                      {81, "ps.spi1.irq"},
                                                      {59, "ps.uart0.irq"},
                                                      {61, "pl.axi_dma_0.mm2s_introut"},
                                                      {62, "pl.axi_dma_1.s2mm_introut"},
                                                      {82, "ps.uart1.irq"}};
  BOOST_TEST(map.interrupts.size() == expected.size());
  for (const auto& interrupt : map.interrupts) {
    BOOST_TEST(expected.at(interrupt.id) == interrupt.source);
  }
}

BOOST_AUTO_TEST_SUITE_END()
