// Which design runs: by its name, by its program, or the usual one.
#include <chip/run/simulation.h>
#include <chip/system/designs.h>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <initializer_list>
#include <optional>
#include <string>

#include <vp/configuration.h>
#include <vp/error.h>

#include "simulation.h"

using namespace platform;

namespace {

/// What is built for a configured `design` and a program that is asked for.
facts::RunFacts built(const std::string& design, const std::optional<std::string>& program) {
  const kit::Simulation context;
  vp::Configuration configuration;
  if (!design.empty()) configuration.set("design", design);
  const vp::Configuration::Scope scope(configuration);
  SimulationOptions options;
  options.program = program;
  const Simulation simulation(options);
  configuration.check_unused();
  return simulation.facts();
}

bool draws_power(const facts::RunFacts& facts) {
  return !facts.resources->modules.empty();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(designs)

BOOST_AUTO_TEST_CASE(the_usual_design_has_its_program) {
  const facts::RunFacts facts = built("", std::nullopt);
  BOOST_TEST(facts.design == "thesis");
  BOOST_TEST(facts.system == "hybrid");
  BOOST_TEST(draws_power(facts));
}

BOOST_AUTO_TEST_CASE(a_design_chooses_its_program) {
  const facts::RunFacts facts = built("ps-only", std::nullopt);
  BOOST_TEST(facts.design == "ps-only");
  BOOST_TEST(facts.system == "ps-only");
  BOOST_TEST(!draws_power(facts));
}

BOOST_AUTO_TEST_CASE(a_program_chooses_its_design) {
  BOOST_TEST(built("", "ps-only").design == "ps-only");
  BOOST_TEST(built("", "hybrid").design == "thesis");
  BOOST_TEST(built("", "improved").design == "improved");
  BOOST_TEST(built("", "blink").design == "thesis");
}

BOOST_AUTO_TEST_CASE(both_may_be_given) {
  const facts::RunFacts facts = built("thesis", "ps-only");
  BOOST_TEST(facts.design == "thesis");
  BOOST_TEST(facts.system == "ps-only");
  BOOST_TEST(draws_power(facts));
}

BOOST_AUTO_TEST_CASE(a_name_that_no_design_has) {
  for (const auto& [name, words] :
       {std::pair{"thesys", "did you mean 'thesis'?"},
        std::pair{"nothing", "thesis, ps-only, improved, hd, eco or careful"}}) {
    BOOST_CHECK_EXCEPTION(built(name, std::nullopt), vp::InputError, [&](const auto& error) {
      return std::string(error.what()).find(words) != std::string::npos;
    });
  }
}

// Before anything runs, with the names of what is in the way and of the key.
BOOST_AUTO_TEST_CASE(places_where_no_device_can_be) {
  const auto refuses = [](const char* setting, std::initializer_list<const char*> words) {
    const kit::Simulation context;
    vp::Configuration configuration;
    configuration.set(setting);
    const vp::Configuration::Scope scope(configuration);
    BOOST_CHECK_EXCEPTION(Zynq(*builtin_designs().front()), vp::InputError, [&](const auto& error) {
      const std::string text = error.what();
      return std::all_of(words.begin(), words.end(),
                         [&](const char* word) { return text.find(word) != std::string::npos; });
    });
  };
  refuses("pl.axi_gpio_1.base_address=0x40410000",
          {"axi_gpio_1", "overlaps axi_dma_1", "pl.axi_gpio_1.base_address"});
  refuses("pl.axi_gpio_1.base_address=0x41218000", {"pl.axi_gpio_1.base_address", "multiple"});
  for (const char* outside : {"0x3FFF0000", "0x80000000", "0xE0000000"}) {
    refuses((std::string("pl.axi_dma_0.base_address=") + outside).c_str(),
            {"pl.axi_dma_0 is at", "m_axi_gp0 reaches 0x40000000 to 0x7FFFFFFF",
             "set pl.axi_dma_0.base_address"});
  }
  refuses("pl.axi_dma_1.s2mm_introut_id=61",
          {"pl.axi_dma_1.s2mm_introut_id is 61", "pl.axi_dma_0.mm2s_introut", "another"});
  refuses("pl.axi_dma_1.s2mm_introut_id=70", {"pl.axi_dma_1.s2mm_introut_id", "61 to 68"});
}

/// The usual design, with a third clock.
DesignInfo with_third_clock() {
  DesignInfo info = *builtin_designs().front();
  info.make = [](const char* name, PlPorts& ports) {
    BOOST_TEST(std::string(ports.fclk_clk(2).name()) == "ps.fclk_clk2.clk");
    BOOST_TEST(&ports.fclk_clk(2) == &ports.fclk_clk(2));
    BOOST_CHECK_THROW(ports.fclk_clk(4), std::out_of_range);
    return builtin_designs().front()->make(name, ports);
  };
  return info;
}

// FCLK 2 and 3 are there for a design that asks, and in no other configuration.
BOOST_AUTO_TEST_CASE(clocks_are_made_for_who_asks) {
  vp::Configuration configuration;
  configuration.set("ps.fclk_clk2.frequency", "21 MHz");
  const vp::Configuration::Scope scope(configuration);
  {
    const kit::Simulation context;
    Zynq zynq(*builtin_designs().front());
    BOOST_TEST(zynq.ps.fclks().size() == 2u);
    BOOST_CHECK_THROW(configuration.check_unused(), vp::InputError);
    BOOST_CHECK_THROW(zynq.ports.fclk_clk(2), std::logic_error);
  }
  const kit::Simulation context;
  Zynq zynq(with_third_clock());
  BOOST_TEST(zynq.ps.fclks().size() == 3u);
  BOOST_CHECK_NO_THROW(configuration.check_unused());
  // 1000 MHz / 48, and the SLCR knows.
  BOOST_TEST(zynq.ports.fclk_clk(2).frequency_hz() == 20'833'333u);
  BOOST_TEST(zynq.ps.slcr.programmed_fclk_hz(2) == 20'833'333u);
  BOOST_TEST(zynq.ps.clock_plan().fclk.size() == 3u);
}

BOOST_AUTO_TEST_SUITE_END()
