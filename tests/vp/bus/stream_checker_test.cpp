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
  explicit Bench(const vp::StreamShape& shape = {"master.m"}) {
    reports.redirect(text);
    master.m.set_shape(shape);
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

/// Beats of two bytes.
struct NarrowBench : Bench {
  NarrowBench() : Bench({"master.m", 2}) {}
};

/// Beats of twelve bytes, with all that may go along.
struct WideBench : Bench {
  WideBench() : Bench({"master.m", 12, 12, 1, 8, 4}) {}
  /// Puts `value` on a wire of the link.
  void put(const char* wire, std::uint32_t value) {
    for (auto& part : link.parts())
      if (part.part.name() == wire) part.wire = value;
  }
  void offer() { master.m.offer(1, false, 0xFF); }
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
BOOST_FIXTURE_TEST_CASE(words_of_a_narrower_link_are_whole, NarrowBench) {
  on(2, [this] { master.m.offer(1, false, 3); });
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(a_short_word_of_a_narrower_link, NarrowBench) {
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
BOOST_FIXTURE_TEST_CASE(a_reset_that_ends_with_tvalid_low_is_silent, Bench) {
  on(3, [this] { rst = true; });
  on(4, [this] { master.m.withdraw(); });
  on(5, [this] { rst = false; });
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(tvalid_that_is_high_when_a_reset_ends, Bench) {
  on(3, [this] { rst = true; });
  on(5, [this] { rst = false; });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TVALID_RESET");
}
BOOST_FIXTURE_TEST_CASE(a_wide_beat_that_waits_is_silent, WideBench) {
  on(2, [this] { offer(); });
  BOOST_TEST(broken() == "");
  BOOST_TEST(link.beats == 1u);
}
BOOST_FIXTURE_TEST_CASE(upper_bytes_of_tdata_that_change, WideBench) {
  on(2, [this] { offer(); });
  on(3, [this] { put("tdata_95_64", 1); });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TDATA_STABLE");
}
BOOST_FIXTURE_TEST_CASE(upper_bytes_that_are_not_kept_may_change, WideBench) {
  on(2, [this] {
    master.m.offer(1, true, 0xFF);
    put("tkeep_11_8", 0);
    put("tstrb", 0xFF);
  });
  on(3, [this] { put("tdata_95_64", 1); });
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(upper_bits_of_tkeep_that_change, WideBench) {
  on(2, [this] { master.m.offer(1, true, 0xFF); });
  on(3, [this] {
    put("tkeep_11_8", 7);
    put("tstrb", 0x7FF);
  });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TKEEP_STABLE AXI4STREAM_ERRM_TSTRB_STABLE");
}
BOOST_FIXTURE_TEST_CASE(tuser_tid_and_tdest_that_change, WideBench) {
  on(2, [this] { offer(); });
  on(3, [this] { put("tuser", 1); });
  on(4, [this] { put("tid", 1); });
  on(5, [this] { put("tdest", 1); });
  BOOST_TEST(broken() ==
             "AXI4STREAM_ERRM_TUSER_STABLE AXI4STREAM_ERRM_TID_STABLE "
             "AXI4STREAM_ERRM_TDEST_STABLE");
}
BOOST_FIXTURE_TEST_CASE(a_short_wide_beat_inside_of_a_packet, WideBench) {
  on(2, [this] {
    offer();
    put("tkeep_11_8", 7);
    put("tstrb", 0x7FF);
  });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TKEEP_GAP");
}
BOOST_FIXTURE_TEST_CASE(tstrb_where_tkeep_is_not, WideBench) {
  on(2, [this] {
    master.m.offer(1, true, 0xFF);
    put("tkeep_11_8", 7);
  });
  BOOST_TEST(broken() == "AXI4STREAM_ERRM_TKEEP_TSTRB");
}
BOOST_AUTO_TEST_CASE(tid_and_tdest_of_more_than_24_bits) {
  Bench wide({"master.m", 4, 0, 0, 16, 9});
  BOOST_TEST(wide.broken() == "AXI4STREAM_AUXM_TID_TDEST_WIDTH");
}
