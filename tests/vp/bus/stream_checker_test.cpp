// The rules of a stream's handshake: each is broken once, what is legal is silent.
#include <boost/test/unit_test.hpp>

#include <simulation.h>

#include <functional>
#include <map>
#include <sstream>
#include <string>

#include <vp/axi_stream.h>
#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <vp/stream_checker.h>

namespace {

/// A master that does on each clock what a test says.
class Master : public vp::Clocked {
 public:
  Master(sc_core::sc_module_name name, vp::Clock& clock) : Clocked(name, clock) { m.reset_by(rst); }
  vp::AxiStreamMaster m{"m", *this};
  vp::In<bool> rst{"rst", this};
  std::map<std::uint64_t, std::function<void()>> on_edge;

 private:
  void edge() override {
    const auto found = on_edge.find(clock().cycle());
    if (found != on_edge.end()) found->second();
  }
};

/// The slave is ready on edge 6 only: it raises READY behind edge 5.
struct Bench : kit::Simulation {
  Bench() {
    reports.redirect(text);
    master.m(link);
    master.rst(rst);
    sink.s_axis(link);
    sink.ready_on = [](std::uint64_t cycle) { return cycle == 5; };
    on(2, [this] { master.m.offer(1, false); });
  }
  void on(std::uint64_t cycle, std::function<void()> what) {
    master.on_edge[cycle] = std::move(what);
  }
  std::string broken() {
    sc_core::sc_start(sc_core::sc_time(100, sc_core::SC_NS));
    sc_core::sc_stop();
    std::string names;
    for (const vp::Warning& warning : reports.warnings())
      names += (names.empty() ? "" : " ") + warning.id.substr(warning.id.rfind('/') + 1);
    return names;
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  std::ostringstream text;
  vp::ReportRouter reports;
  vp::Signal<bool> rst{"rst"};
  vp::AxiStream link{"link"};
  Master master{"master", clock};
  vp::StreamSink sink{"sink", clock};
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_beat_that_waits_is_silent, Bench) {
  on(6, [this] { master.m.offer(2, true); });  // the first one passes on this edge
  BOOST_TEST(broken() == "");
  BOOST_TEST(link.beats == 1u);
}
BOOST_FIXTURE_TEST_CASE(tvalid_that_falls, Bench) {
  on(4, [this] { master.m.withdraw(); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TVALID_STABLE");
  BOOST_TEST(text.str().find("edge 4 of clock, at 40 ns") != std::string::npos, text.str());
}
BOOST_FIXTURE_TEST_CASE(tvalid_that_falls_on_the_edge_that_raises_tready, Bench) {
  on(5, [this] { master.m.withdraw(); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TVALID_STABLE");
}
BOOST_FIXTURE_TEST_CASE(tdata_that_changes, Bench) {
  on(3, [this] { master.m.offer(2, false); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TDATA_STABLE");
}
// It listens to TDATA only while a beat waits: again in the second wait, and on the edge that ends
// it.
BOOST_FIXTURE_TEST_CASE(tdata_that_changes_in_a_later_wait, Bench) {
  on(6, [this] { master.m.withdraw(); });  // the first one passes on this edge
  on(7, [this] { master.m.offer(3, false); });
  on(8, [this] { master.m.offer(4, false); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TDATA_STABLE");
}
BOOST_FIXTURE_TEST_CASE(tdata_that_changes_on_the_edge_that_raises_tready, Bench) {
  on(5, [this] { master.m.offer(2, false); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TDATA_STABLE");
}
BOOST_FIXTURE_TEST_CASE(data_of_bytes_that_are_not_kept_may_change, Bench) {
  on(2, [this] { master.m.offer(0x1'00, true, 1); });
  on(3, [this] { master.m.offer(0x2'00, true, 1); });
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(tlast_that_changes, Bench) {
  on(3, [this] { master.m.offer(1, true); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TLAST_STABLE");
}
BOOST_FIXTURE_TEST_CASE(tkeep_that_changes, Bench) {
  on(2, [this] { master.m.offer(1, true); });
  on(3, [this] { master.m.offer(1, true, 3); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TKEEP_STABLE");
}
BOOST_FIXTURE_TEST_CASE(a_short_word_inside_of_a_packet, Bench) {
  on(2, [this] { master.m.offer(1, false, 3); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TKEEP_GAP");
}
BOOST_FIXTURE_TEST_CASE(words_of_a_narrower_link_are_whole, Bench) {
  sc_core::sc_attribute<unsigned> bytes(vp::beat_bytes_attribute, 2);
  link.add_attribute(bytes);
  on(2, [this] { master.m.offer(1, false, 3); });
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(a_short_word_of_a_narrower_link, Bench) {
  sc_core::sc_attribute<unsigned> bytes(vp::beat_bytes_attribute, 2);
  link.add_attribute(bytes);
  on(2, [this] { master.m.offer(1, false, 1); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TKEEP_GAP");
}
BOOST_FIXTURE_TEST_CASE(a_short_word_at_the_end_of_a_packet_is_silent, Bench) {
  on(2, [this] { master.m.offer(1, true, 3); });
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(a_reset_may_drop_a_beat, Bench) {
  on(3, [this] { rst = true; });
  on(4, [this] { master.m.withdraw(); });
  BOOST_TEST(broken() == "");
}
