// Each rule of a memory-mapped link is broken once, and only that rule is said to be; what is legal
// is silent.
#include <boost/test/unit_test.hpp>

#include <simulation.h>

#include <sstream>
#include <string>
#include <vector>

#include <axi/link_checker.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/report.h>

#include "adapter_bench.h"

namespace {

using axi::BurstType;
using axi::Response;

/// Wires that a test sets, edge by edge.
struct Bench : kit::Simulation {
  explicit Bench(bool lite = false) : checker(clock, clock, shape(lite)) { reports.redirect(text); }
  static axi::Shape shape(bool lite) {
    axi::Shape shape;
    shape.lite = lite;
    return shape;
  }
  static axi::Address request(std::uint64_t address, unsigned beats = 1,
                              BurstType burst = BurstType::incr, unsigned size = 2) {
    axi::Address a;
    a.address = address;
    a.beats = beats;
    a.burst = burst;
    a.size = size;
    return a;
  }
  void edge(bool in_reset = false) {
    checker.edge(wires, in_reset);
    wires = axi::Wires();
  }
  void aw(const axi::Address& a, bool ready = true) { set(wires.aw, a, ready); }
  void ar(const axi::Address& a, bool ready = true) { set(wires.ar, a, ready); }
  static void set(axi::AddressChannel& channel, const axi::Address& a, bool ready) {
    channel.valid = true;
    channel.ready = ready;
    channel.beat = a;
  }
  void w(bool last, unsigned char data = 0, unsigned strobes = 0xF, bool ready = true) {
    wires.w.valid = true;
    wires.w.ready = ready;
    wires.w.last = last;
    wires.w.data[0] = data;
    wires.w.strobes = axi::Strobes(strobes);
  }
  void b(Response response = Response::okay, unsigned id = 0, bool ready = true) {
    wires.b.valid = true;
    wires.b.ready = ready;
    wires.b.response = response;
    wires.b.id = id;
  }
  void r(bool last, Response response = Response::okay, unsigned id = 0, bool ready = true) {
    wires.r.valid = true;
    wires.r.ready = ready;
    wires.r.last = last;
    wires.r.response = response;
    wires.r.id = id;
  }
  /// A write of one beat.
  void write(const axi::Address& a) {
    aw(a);
    edge();
    for (unsigned i = 0; i < a.beats; ++i) w(i + 1 == a.beats), edge();
    b();
    edge();
  }
  void read(const axi::Address& a) {
    ar(a);
    edge();
    for (unsigned i = 0; i < a.beats; ++i) r(i + 1 == a.beats), edge();
  }
  /// The names of the rules that were broken, in order.
  std::string broken() {
    checker.finish();
    std::string names;
    for (const vp::Warning& warning : reports.warnings())
      names += (names.empty() ? "" : " ") + warning.id.substr(warning.id.rfind('/') + 1);
    return names;
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  std::ostringstream text;
  vp::ReportRouter reports;
  axi::Wires wires;
  axi::LinkChecker checker;
};

struct Lite : Bench {
  Lite() : Bench(true) {}
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(legal_transfers_are_silent, Bench) {
  write(request(0xFF0, 4));
  write(request(0x108, 4, BurstType::wrap));
  write(request(0x100, 16, BurstType::fixed));
  read(request(0x101, 256));
  w(false), edge();  // data before its address
  w(true), edge();
  aw(request(0x100, 2)), edge();
  b(), edge();
  aw(request(0x100), false), edge();  // waits
  aw(request(0x100)), w(true), edge();
  b(Response::slverr, 0, false), edge();
  b(Response::slverr), edge();
  ar(request(0x100)), edge();
  ar(request(0x200)), r(true), edge();
  r(true, Response::decerr), edge();
  BOOST_TEST(broken() == "");
}

BOOST_FIXTURE_TEST_CASE(a_burst_across_4_kib, Bench) {
  read(request(0xFF8, 4));
  BOOST_TEST(broken() == "AXI4_ERRM_ARADDR_BOUNDARY");
}
BOOST_FIXTURE_TEST_CASE(a_wrap_from_the_middle_of_a_beat, Bench) {
  read(request(0x102, 4, BurstType::wrap));
  BOOST_TEST(broken() == "AXI4_ERRM_ARADDR_WRAP_ALIGN");
}
BOOST_FIXTURE_TEST_CASE(a_wrap_of_three, Bench) {
  read(request(0x100, 3, BurstType::wrap));
  BOOST_TEST(broken() == "AXI4_ERRM_ARLEN_WRAP");
}
BOOST_FIXTURE_TEST_CASE(a_fixed_of_seventeen, Bench) {
  read(request(0x100, 17, BurstType::fixed));
  BOOST_TEST(broken() == "AXI4_ERRM_ARLEN_FIXED");
}
BOOST_FIXTURE_TEST_CASE(burst_type_three, Bench) {
  read(request(0x100, 1, BurstType::reserved));
  BOOST_TEST(broken() == "AXI4_ERRM_ARBURST");
}
BOOST_FIXTURE_TEST_CASE(a_beat_wider_than_the_data, Bench) {
  read(request(0x100, 1, BurstType::incr, 3));
  BOOST_TEST(broken() == "AXI4_ERRM_ARSIZE");
}
BOOST_FIXTURE_TEST_CASE(allocation_of_what_is_not_modifiable, Bench) {
  axi::Address a = request(0x100);
  a.cache = 8;
  read(a);
  BOOST_TEST(broken() == "AXI4_ERRM_ARCACHE");
}
BOOST_FIXTURE_TEST_CASE(an_exclusive_access_of_seventeen_beats, Bench) {
  axi::Address a = request(0x100, 17);
  a.lock = true;
  read(a);
  BOOST_TEST(broken() == "AXI4_ERRM_ARLEN_LOCK");
}
BOOST_FIXTURE_TEST_CASE(an_address_that_changes_while_it_waits, Bench) {
  aw(request(0x100), false), edge();
  aw(request(0x104)), w(true), edge();
  b(), edge();
  BOOST_TEST(broken() == "AXI4_ERRM_AWADDR_STABLE");
}
BOOST_FIXTURE_TEST_CASE(arvalid_that_falls, Bench) {
  ar(request(0x100), false), edge();
  edge();
  BOOST_TEST(broken() == "AXI4_ERRM_ARVALID_STABLE");
}
BOOST_FIXTURE_TEST_CASE(write_data_that_change, Bench) {
  aw(request(0x100)), w(true, 1, 0xF, false), edge();
  w(true, 2), edge();
  b(), edge();
  BOOST_TEST(broken() == "AXI4_ERRM_WDATA_STABLE");
}
BOOST_FIXTURE_TEST_CASE(a_response_of_one_clock, Bench) {
  aw(request(0x100)), w(true), edge();
  b(Response::okay, 0, false), edge();
  edge();
  b(), edge();
  BOOST_TEST(broken() == "AXI4_ERRS_BVALID_STABLE");
}
BOOST_FIXTURE_TEST_CASE(read_data_that_change, Bench) {
  ar(request(0x100)), edge();
  r(true, Response::okay, 0, false), edge();
  r(true, Response::slverr), edge();
  BOOST_TEST(broken() == "AXI4_ERRS_RRESP_STABLE");
}
BOOST_FIXTURE_TEST_CASE(valid_behind_reset, Bench) {
  edge(true);
  ar(request(0x100), false), edge();
  ar(request(0x100)), edge();
  r(true), edge();
  BOOST_TEST(broken() == "AXI4_ERRM_ARVALID_RESET");
}
BOOST_FIXTURE_TEST_CASE(a_reset_ends_what_is_under_way, Bench) {
  ar(request(0x100), false), edge();
  edge(true);
  edge();
  aw(request(0x100)), edge();
  edge(true);
  edge();
  BOOST_TEST(broken() == "");
}
BOOST_FIXTURE_TEST_CASE(wlast_one_early, Bench) {
  aw(request(0x100, 2)), w(true), edge();
  b(), edge();
  BOOST_TEST(broken() == "AXI4_ERRM_WDATA_NUM");
}
BOOST_FIXTURE_TEST_CASE(wlast_that_is_missing, Bench) {
  aw(request(0x100)), edge();
  w(false), edge();
  b(), edge();
  BOOST_TEST(broken() == "AXI4_ERRM_WDATA_NUM");
}
BOOST_FIXTURE_TEST_CASE(strobes_outside_of_a_narrow_beat, Bench) {
  aw(request(0x100, 1, BurstType::incr, 0)), edge();
  w(true, 0, 0x3), edge();
  b(), edge();
  BOOST_TEST(broken() == "AXI4_ERRM_WSTRB");
}
BOOST_FIXTURE_TEST_CASE(a_response_in_the_clock_of_the_address, Bench) {
  aw(request(0x100)), w(true), b(), edge();
  b(), edge();
  BOOST_TEST(broken() == "AXI4_ERRS_BRESP_AW");
}
BOOST_FIXTURE_TEST_CASE(a_response_behind_the_first_of_two_beats, Bench) {
  aw(request(0x100, 2)), edge();
  w(false), edge();
  b(Response::okay, 0, false), edge();
  b(Response::okay, 0, false), w(true), edge();
  b(), edge();
  BOOST_TEST(broken() == "AXI4_ERRS_BRESP_WLAST");
}
BOOST_FIXTURE_TEST_CASE(a_response_of_another_id, Bench) {
  aw(request(0x100)), w(true), edge();
  b(Response::okay, 3), edge();
  b(), edge();
  BOOST_TEST(broken() == "AXI4_ERRS_BID");
}
BOOST_FIXTURE_TEST_CASE(data_in_the_clock_of_the_request, Bench) {
  ar(request(0x100)), r(true), edge();
  r(true), edge();
  BOOST_TEST(broken() == "AXI4_ERRS_RID");
}
BOOST_FIXTURE_TEST_CASE(rlast_that_never_comes, Bench) {
  ar(request(0x100, 2)), edge();
  r(false), edge();
  r(false), edge();
  BOOST_TEST(broken() == "AXI4_ERRS_RDATA_NUM");
}
BOOST_FIXTURE_TEST_CASE(exokay_to_a_plain_access, Bench) {
  ar(request(0x100)), edge();
  r(true, Response::exokay), edge();
  BOOST_TEST(broken() == "AXI4_ERRS_RRESP_EXOKAY");
}
BOOST_FIXTURE_TEST_CASE(exokay_of_axi4_lite, Lite) {
  aw(request(0x100)), w(true), edge();
  b(Response::exokay), edge();
  BOOST_TEST(broken() == "AXI4_ERRS_BRESP_EXOKAY");
}
BOOST_FIXTURE_TEST_CASE(a_read_that_is_open_at_the_end, Bench) {
  ar(request(0x100)), edge();
  BOOST_TEST(broken() == "AXI4_ERR_ALL_DONE_EOS");
}

BOOST_FIXTURE_TEST_CASE(a_rule_is_warned_of_once_with_its_count, Bench) {
  for (int i = 0; i < 3; ++i) read(request(0xFF8, 4));
  BOOST_TEST(broken() == "AXI4_ERRM_ARADDR_BOUNDARY");
  BOOST_TEST(text.str().find("was broken 3 times") != std::string::npos, text.str());
  BOOST_TEST(text.str().find("INCR of 4 beats of 4 bytes from 0x") != std::string::npos);
  BOOST_TEST(text.str().find("edge 0 of clock") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_rule_is_switched_off_by_the_configuration) {
  vp::Configuration configuration;
  configuration.set("checks.AXI4_ERRM_ARADDR_BOUNDARY", "false");
  const vp::Configuration::Scope scope(configuration);
  Bench bench;
  const vp::ProtocolChecks checks("checks");
  bench.read(Bench::request(0xFF8, 4));
  bench.read(Bench::request(0x100, 3, BurstType::wrap));
  BOOST_TEST(bench.broken() == "AXI4_ERRM_ARLEN_WRAP");
  configuration.check_unused();
}

BOOST_AUTO_TEST_CASE(random_transfers_of_our_adapters_break_no_rule) {
  kit::AdapterBench bench({}, true);
  std::ostringstream text;
  vp::ReportRouter reports;
  reports.redirect(text);
  axi::LinkChecker checker(bench.clock, bench.clock, {});
  bench.pair.watch = [&](const axi::Wires& wires) { checker.edge(wires, false); };
  std::vector<unsigned char> data(300);
  bench.software.simulate([&] {
    for (unsigned i = 0; i < 500; ++i) {
      const auto length = static_cast<unsigned>(1 + bench.pair.random.next() % 300);
      bench.access(i % 2 ? tlm::TLM_READ_COMMAND : tlm::TLM_WRITE_COMMAND,
                   bench.pair.random.next() % 0x8000, data.data(), length);
    }
  });
  checker.finish();
  BOOST_TEST(reports.warnings().empty(), text.str());
}
