// The RTL between two clocks, that of the camera and that of the buses: in lock-step with the
// models, in their place, and with bugs, each of which is found at its port.
#include <dlfcn.h>
#include <pl/common/rtl_interface.h>
#include <pl/control_crossing/control_crossing.h>
#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>

#include <boost/test/unit_test.hpp>

#include "crossing_bench.h"
#include "frames.h"
#include "improved_chain.h"
#include "pipeline.h"
#include "rtl_objects.h"

namespace {

using harness::several_clocks;
using harness::StreamBench;
using harness::TwoClocks;
using Strings = std::vector<std::string>;

const Bug control_bugs[] = {
    {"one_register_only", "control_crossing", "control_crossing.sv", "second <= first",
     "second <= {ena_in, rst_in, por_in, wr_thresh_in, threshold_in}", ""},
    {"resets_swapped", "control_crossing", "control_crossing.sv", "assign {ena, rst, por,",
     "assign {ena, por, rst,", "rst"},
    {"threshold_lags", "control_crossing", "control_crossing.sv", "second <= first;",
     "second <= {first[11:8], second[0], first[7:1]};", "threshold"}};

const Bug stream_bugs[] = {
    {"count_in_one_register", "stream_crossing", "stream_crossing.sv", "read_seen   <= read_first",
     "read_seen   <= read_gray", "s_tready"},
    {"taker_not_asked", "stream_crossing", "stream_crossing.sv", "empty && ready_seen", "empty",
     "s_tready"},
    {"packets_overlap", "stream_crossing", "stream_crossing.sv", "in_packet    <= !s_tlast",
     "in_packet    <= 1'b1", "s_tready"},
    {"never_full", "stream_crossing", "stream_crossing.sv", "in_packet ? !full", "in_packet ? 1'b1",
     "s_tready"},
    {"half_a_turn", "stream_crossing", "stream_crossing.sv", "TURN = BITS'(3)", "TURN = BITS'(1)",
     ""},
    {"packet_without_end", "stream_crossing", "stream_crossing.sv", "{s_tlast, s_tdata}",
     "{1'b0, s_tdata}", "m_tlast"},
    {"seen_too_soon", "stream_crossing", "stream_crossing.sv", "written_seen  <= written_first",
     "written_seen  <= written_gray", "m_tvalid"},
    {"read_before_it_passes", "stream_crossing", "stream_crossing.sv", "(m_tvalid && m_tready)",
     "m_tvalid", "m_t"},
    {"flush_stays_here", "stream_crossing", "stream_crossing.sv", "flush_seen    <= flush_first",
     "flush_seen    <= 1'b0", "m_tvalid"},
    {"flush_to_nowhere", "stream_crossing", "stream_crossing.sv", "? binary(written_seen)",
     "? written_seen", "m_t"}};

/// No bug: the same registers, with another one that takes over as the clock falls.
const Bug falling_edge{
    "works_on_falling_edges",
    "control_crossing",
    "control_crossing.sv",
    "second <= first;",
    "second <= half;\n  end\n  logic [11:0] half = '0;\n  always_ff @(negedge clk) begin\n"
    "    half <= first;",
    ""};

const RtlObjects& objects() {
  static const RtlObjects built = [] {
    std::vector<RtlObjects::Object> all{{"control_crossing", "control_crossing", ""},
                                        {"stream_crossing", "stream_crossing", "DEPTH=8"},
                                        {"deep_crossing", "stream_crossing", "DEPTH=16"}};
    all.push_back({falling_edge.name, falling_edge.ip, "", &falling_edge});
    for (const Bug& bug : control_bugs) all.push_back({bug.name, bug.ip, "", &bug});
    for (const Bug& bug : stream_bugs) all.push_back({bug.name, bug.ip, "DEPTH=8", &bug});
    return RtlObjects(all);
  }();
  return built;
}

std::string in_place(const std::string& instance, const std::string& object) {
  return "fidelity." + instance + "=" + objects().file(object);
}
std::string lockstep(const std::string& instance, const std::string& object) {
  return "fidelity." + instance + "=lockstep:" + objects().file(object);
}

/// Software that writes at any time, and the pixel clock to which it crosses.
struct ControlBench : kit::Simulation {
  explicit ControlBench(const Strings& more) : settings(more) {
    reports.redirect(warnings);  // of levels that are too short
    crossing->ena_in(software.ena);
    crossing->rst_in(software.rst);
    crossing->por_in(software.por);
    crossing->wr_thresh_in(software.wr_thresh);
    crossing->threshold_in(software.threshold);
  }
  /// What leaves after each of some hundred writes.
  std::string seen() {
    std::string text;
    for (int i = 0; i < 500; ++i) {
      sc_core::sc_start(vp::from_ps(3'000 + random.below(60'000)));
      scheduler.synchronise();
      for (vp::Signal<bool>* level :
           {&software.ena, &software.rst, &software.por, &software.wr_thresh})
        *level = random.below(2) != 0;
      software.threshold = static_cast<std::uint8_t>(random.below(256));
      text += std::to_string(crossing->ena + 2 * crossing->rst + 4 * crossing->por +
                             8 * crossing->wr_thresh + 16 * crossing->threshold) +
              " ";
    }
    return text;
  }
  std::string failure() {
    return failure_of([this] { seen(); });
  }

  struct Fidelity : sc_core::sc_module {
    explicit Fidelity(sc_core::sc_module_name name) : sc_module(name) {}
    pl::Choice<pl::ControlCrossing> control_crossing{pl::ControlCrossing::models(),
                                                     pl::Fidelity::clocked};
  };

  harness::Settings settings;
  harness::Random random{7};
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 25'175'000};
  harness::ChainControl software;
  Fidelity fidelity{"fidelity"};
  std::unique_ptr<pl::ControlCrossing> crossing =
      fidelity.control_crossing.make({clk, pl::Geometry{64, 32, 32}});
  std::ostringstream warnings;
  vp::ReportRouter reports;
};

std::string stream_failure(const Strings& settings, const TwoClocks& clocks) {
  StreamBench bench(settings, clocks);
  return failure_of([&bench] { bench.play(); });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(crossing_rtl)

BOOST_AUTO_TEST_CASE(control_crosses_as_in_the_model) {
  BOOST_TEST(ControlBench({lockstep("control_crossing", "control_crossing")}).failure() == "");
  const std::string models = ControlBench({}).seen();
  BOOST_TEST(ControlBench({in_place("control_crossing", "control_crossing")}).seen() == models);
  for (const Bug& bug : control_bugs) {
    const std::string failure = ControlBench({lockstep("control_crossing", bug.name)}).failure();
    check_port(bug, failure);
  }
}

/// Whether its clocks may fall without an evaluation.
bool clocks_fall_unseen(const std::string& object) {
  void* library = ::dlopen(objects().file(object).c_str(), RTLD_NOW | RTLD_LOCAL);
  BOOST_TEST_REQUIRE(library != nullptr);
  void* symbol = ::dlsym(library, RTL_SYMBOL);
  BOOST_TEST_REQUIRE(symbol != nullptr);
  return reinterpret_cast<const RtlDescriptor* (*)()>(symbol)()->lower != nullptr;
}

BOOST_AUTO_TEST_CASE(rtl_that_works_on_falling_edges_sees_them) {
  BOOST_TEST(clocks_fall_unseen("control_crossing"));
  BOOST_TEST(clocks_fall_unseen("stream_crossing"));
  BOOST_TEST(!clocks_fall_unseen(falling_edge.name));
  BOOST_TEST(ControlBench({lockstep("control_crossing", falling_edge.name)}).failure() == "");
}

BOOST_AUTO_TEST_CASE(a_stream_crosses_as_in_the_model) {
  for (const TwoClocks& clocks : several_clocks) {
    const auto& [pixels, bus, gated] = clocks;
    BOOST_TEST(stream_failure({lockstep("pixel_crossing", "stream_crossing")}, clocks) == "",
               pixels << ", " << bus << ", " << gated);
    const std::string model = StreamBench({}, clocks).seen();
    BOOST_TEST(model.size() > 10'000u);
    BOOST_TEST(
        (StreamBench({in_place("pixel_crossing", "stream_crossing")}, clocks).seen() == model),
        pixels << ", " << bus << ", " << gated);
  }
}

// For the page of a difference: they lie outside of the IP.
BOOST_AUTO_TEST_CASE(wires_of_the_model_stand_beside_those_of_the_rtl) {
  StreamBench bench({lockstep("pixel_crossing", "stream_crossing")}, several_clocks[0]);
  const auto wire = [](const std::string& name) -> vp::SignalBase& {
    auto* found = dynamic_cast<vp::SignalBase*>(
        sc_core::sc_find_object(("pixel_crossing.rtl.model." + name).c_str()));
    BOOST_TEST_REQUIRE(found != nullptr, name);
    return *found;
  };
  const harness::ChangeLog ready(bench.before.tready, bench.scheduler),
      ready_beside(wire("s_tready"), bench.scheduler), data(bench.behind.tdata, bench.scheduler),
      data_beside(wire("m_tdata"), bench.scheduler);
  bench.play();
  BOOST_TEST(ready.changes.size() > 100u);
  BOOST_TEST(ready_beside.changes == ready.changes, boost::test_tools::per_element());
  BOOST_TEST(data_beside.changes == data.changes, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(rtl_of_two_clocks_sleeps_on_both) {
  for (const TwoClocks& clocks : several_clocks) {
    StreamBench bench({in_place("pixel_crossing", "stream_crossing")}, clocks);
    bench.play();
    const std::uint64_t pixel_edges = bench.pixels.edges_run(), bus_edges = bench.bus.edges_run();
    bench.pass(10'000);
    BOOST_TEST(bench.pixels.edges_run() - pixel_edges < 10u, clocks.pixels_hz);
    BOOST_TEST(bench.bus.edges_run() - bus_edges < 10u, clocks.pixels_hz);
  }
}

BOOST_AUTO_TEST_CASE(each_bug_of_a_stream_crossing_is_found_at_its_port) {
  for (const Bug& bug : stream_bugs) {
    const Strings beside{lockstep("pixel_crossing", bug.name)};
    check_port(bug, stream_failure(beside, several_clocks[0]));
    // Where that of the pixels is far faster, the other side may show it first.
    BOOST_TEST(stream_failure(beside, several_clocks[4]) != "", bug.name);
  }
}

BOOST_AUTO_TEST_CASE(another_depth_or_another_ip_is_refused) {
  const auto refused = [](const std::string& object) {
    try {
      StreamBench({in_place("pixel_crossing", object)}, several_clocks[0]);
    } catch (const vp::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string deep = refused("deep_crossing");
  BOOST_TEST(
      deep.find("DEPTH is 16, and pixel_crossing.depth 8: build it with PARAMETERS DEPTH=8") !=
          std::string::npos,
      deep);
  const std::string control = refused("control_crossing");
  BOOST_TEST(control.find("built as control_crossing") != std::string::npos, control);
}

BOOST_AUTO_TEST_SUITE_END()
