// The statistics of a trace and the counters of the models that drew it.
#include <boost/test/unit_test.hpp>

#include <map>

#include <chip/run/simulation.h>
#include <marker/designs/marker/marker_design.h>
#include <marker/input/image_input.h>
#include <trace/statistics.h>
#include <vp/configuration.h>
#include <vp/counter.h>

#include "simulation.h"
#include "temporary_files.h"

namespace {

using platform::trace::Table;

struct Counted {
  std::map<std::string, std::uint64_t> counters;
  std::vector<Table> tables;

  std::uint64_t traced(const std::string& table, const std::string& row,
                       const std::string& column) const {
    for (const Table& t : tables) {
      if (t.name != table) continue;
      for (const auto& cells : t.rows) {
        if (std::get<std::string>(cells[0]) != row) continue;
        for (std::size_t c = 0; c < t.columns.size(); ++c) {
          if (t.columns[c] == column) return std::get<std::uint64_t>(cells[c]);
        }
      }
    }
    throw std::runtime_error("no " + table + "." + row + "." + column);
  }
};

/// Three scenes, counted by the models and from the trace.
Counted run(const std::vector<std::pair<std::string, std::string>>& settings) {
  const kit::Simulation context;
  const kit::TemporaryFolder folder;
  vp::Configuration configuration;
  for (const auto& [path, value] : settings) configuration.set(path, value);
  const vp::Configuration::Scope scope(configuration);
  vp::TraceOptions trace;
  trace.file = folder / "t.vcd";
  platform::Simulation simulation({MARKERVP_HYBRID, trace});
  platform::input::InputOptions options;
  options.size = platform::input::image_size(simulation.input());
  const auto source = platform::input::open_inputs({"demo", "z0.5", "z1.0"}, options);
  simulation.run([&] { return source->next(); },
                 [](platform::facts::UnitReport&&) { return true; });
  Counted result;
  for (const vp::Counter* counter : vp::all_counters()) {
    result.counters[counter->name()] = counter->get();
  }
  platform::trace::TraceFile file(folder / "t.vcd");
  result.tables = platform::trace::statistics(file, platform::marker_words());
  return result;
}

void compare(const Counted& counted) {
  for (const char* link : {"pl.image_stream", "pl.binary_stream"}) {
    for (const char* number : {"beats", "packets", "stalls"}) {
      BOOST_TEST(counted.traced("links", link, number) ==
                     counted.counters.at(std::string(link) + "." + number),
                 link << " " << number);
    }
  }
  BOOST_TEST(counted.traced("interrupts", "pl.axi_dma_0.mm2s_introut", "served") +
                 counted.traced("interrupts", "pl.axi_dma_1.s2mm_introut", "served") ==
             counted.counters.at("ps.gic.acknowledged"));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(trace_counters)

BOOST_AUTO_TEST_CASE(a_bus_as_it_is) {
  const Counted counted = run({{"fidelity", "clocked"}});
  compare(counted);
}

// Back-pressure on both streams: a slow memory, a slow bus, full buffers.
BOOST_AUTO_TEST_CASE(a_slow_bus_with_overflows) {
  const Counted counted = run({{"fidelity", "clocked"},
                               {"pl.feature_packaging.buffer_depth", "2"},
                               {"pl.axi_dma_1.memory_write_latency", "90 cycles"},
                               {"ps.m_axi_gp0.read_time", "5 us"}});
  compare(counted);
  BOOST_TEST(counted.traced("links", "pl.binary_stream", "stalls") > 1000u);
  BOOST_TEST(counted.traced("overflows", "pl.feature_packaging.feature_overflow", "lost") > 0u);
}

BOOST_AUTO_TEST_SUITE_END()
