// Each rule of a memory-mapped link is broken once, and only that rule is said to be; what is legal
// is silent.
#include <boost/test/unit_test.hpp>

#include <simulation.h>

#include <deque>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
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
  unsigned left = 1;  ///< of two IDs, the one that is answered last
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
BOOST_FIXTURE_TEST_CASE(bvalid_during_reset, Bench) {
  edge(true);
  b(Response::okay, 0, false), edge(true);
  edge();
  BOOST_TEST(broken() == "AXI4_ERRS_BVALID_RESET");
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

namespace {

/// What breaks a rule and no other, on a link of its own.
struct Breach {
  const char* rule;
  std::function<void(Bench&)> act;
};

/// A request that waits, and changes before it passes.
Breach changed(const char* rule, bool read, std::function<void(axi::Address&)> change) {
  return {rule, [read, change = std::move(change)](Bench& b) {
            axi::Address a = Bench::request(0x100, 2);
            const auto put = [&](bool ready) { read ? b.ar(a, ready) : b.aw(a, ready); };
            put(false), b.edge();
            change(a);
            put(true), b.edge();
            for (unsigned i = 0; i < a.beats; ++i) {
              const bool last = i + 1 == a.beats;
              read ? b.r(last, Response::okay, a.id) : b.w(last, 0, 1u << (i << a.size & 3));
              b.edge();
            }
            if (!read) b.b(Response::okay, a.id), b.edge();
          }};
}

/// A request that is illegal by itself.
Breach illegal(const char* rule, bool read, const axi::Address& request) {
  return {rule, [read, request](Bench& b) {
            if (read) return b.read(request);
            b.aw(request), b.edge();
            for (unsigned i = 0; i < request.beats; ++i) {
              b.w(i + 1 == request.beats, 0, 0), b.edge();
            }
            b.b(), b.edge();
          }};
}

std::vector<Breach> breaches() {
  std::vector<Breach> all;
  const auto names = [](const std::string& name, bool read) {
    static std::deque<std::string> kept;
    return kept.emplace_back("AXI4_ERRM_" + std::string(read ? "AR" : "AW") + name).c_str();
  };
  for (const bool read : {false, true}) {
    const auto change = [&](const char* name, std::function<void(axi::Address&)> what) {
      all.push_back(changed(names(name, read), read, std::move(what)));
    };
    change("ADDR_STABLE", [](axi::Address& a) { a.address += 8; });
    change("ID_STABLE", [](axi::Address& a) { a.id = 1; });
    change("LEN_STABLE", [](axi::Address& a) { a.beats = 3; });
    change("SIZE_STABLE", [](axi::Address& a) { a.size = 1; });
    change("BURST_STABLE", [](axi::Address& a) { a.burst = BurstType::fixed; });
    change("LOCK_STABLE", [](axi::Address& a) { a.lock = true; });
    change("CACHE_STABLE", [](axi::Address& a) { a.cache = 3; });
    change("PROT_STABLE", [](axi::Address& a) { a.prot = 1; });
    change("QOS_STABLE", [](axi::Address& a) { a.qos = 1; });
    change("REGION_STABLE", [](axi::Address& a) { a.region = 1; });
    const auto wrong = [&](const char* name, const axi::Address& a) {
      all.push_back(illegal(names(name, read), read, a));
    };
    wrong("ADDR_BOUNDARY", Bench::request(0xFF8, 4));
    wrong("ADDR_WRAP_ALIGN", Bench::request(0x102, 4, BurstType::wrap));
    wrong("LEN_WRAP", Bench::request(0x100, 3, BurstType::wrap));
    wrong("LEN_FIXED", Bench::request(0x100, 17, BurstType::fixed));
    wrong("BURST", Bench::request(0x100, 1, BurstType::reserved));
    wrong("SIZE", Bench::request(0x100, 1, BurstType::incr, 3));
    axi::Address special = Bench::request(0x100);
    special.cache = 8;
    wrong("CACHE", special);
    special = Bench::request(0x100, 17);
    special.lock = true;
    wrong("LEN_LOCK", special);
    all.push_back({names("VALID_STABLE", read), [read](Bench& b) {
                     const axi::Address a = Bench::request(0x100);
                     read ? b.ar(a, false) : b.aw(a, false);
                     b.edge(), b.edge();
                   }});
    all.push_back({names("VALID_RESET", read), [read](Bench& b) {
                     const axi::Address a = Bench::request(0x100);
                     b.edge(true);
                     read ? b.ar(a, false) : b.aw(a, false);
                     b.edge(true), b.edge();
                   }});
  }
  return all;
}

/// The same for the other channels: what is offered first and does not pass, and what passes then.
std::vector<Breach> breaches_of_answers() {
  const auto after_write = [](std::function<void(Bench&)> first, std::function<void(Bench&)> then) {
    return [=](Bench& b) {
      for (unsigned id : {0u, 1u}) {
        axi::Address a = Bench::request(0x100);
        a.id = id;
        b.aw(a), b.w(true), b.edge();
      }
      first(b), b.edge();
      then(b), b.edge();
      b.b(Response::okay, b.left), b.edge();
    };
  };
  const auto after_read = [](std::function<void(Bench&)> first, std::function<void(Bench&)> then) {
    return [=](Bench& b) {
      for (unsigned id : {0u, 1u}) {
        axi::Address a = Bench::request(0x100);
        a.id = id;
        b.ar(a), b.edge();
      }
      first(b), b.edge();
      then(b), b.edge();
      b.r(true, Response::okay, b.left), b.edge();
    };
  };
  const auto waits_b = [](Bench& b) { b.b(Response::okay, 0, false); };
  const auto waits_r = [](Bench& b) { b.r(true, Response::okay, 0, false); };
  return {
      {"AXI4_ERRS_BID_STABLE",
       after_write(waits_b, [](Bench& b) { b.b(Response::okay, 1), b.left = 0; })},
      {"AXI4_ERRS_BRESP_STABLE", after_write(waits_b, [](Bench& b) { b.b(Response::slverr); })},
      {"AXI4_ERRS_RID_STABLE",
       after_read(waits_r, [](Bench& b) { b.r(true, Response::okay, 1), b.left = 0; })},
      {"AXI4_ERRS_RRESP_STABLE",
       after_read(waits_r, [](Bench& b) { b.r(true, Response::slverr); })},
      {"AXI4_ERRS_RDATA_STABLE",
       after_read(waits_r, [](Bench& b) { b.r(true), b.wires.r.data[3] = 1; })},
      {"AXI4_ERRS_RLAST_STABLE", after_read([](Bench& b) { b.r(false, Response::okay, 0, false); },
                                            [](Bench& b) { b.r(true); })},
      {"AXI4_ERRS_RVALID_STABLE",
       [](Bench& b) {
         b.ar(Bench::request(0x100)), b.edge();
         b.r(true, Response::okay, 0, false), b.edge();
         b.edge();
         b.r(true), b.edge();
       }},
      {"AXI4_ERRS_RVALID_RESET",
       [](Bench& b) { b.edge(true), b.r(true, Response::okay, 0, false), b.edge(true), b.edge(); }},
      {"AXI4_ERRM_WVALID_RESET", [](Bench& b) { b.edge(true), b.w(true), b.edge(true), b.edge(); }},
      {"AXI4_ERRM_WVALID_STABLE", [](Bench& b) { b.w(true, 0, 0xF, false), b.edge(), b.edge(); }},
      {"AXI4_ERRM_WSTRB_STABLE",
       [](Bench& b) {
         b.aw(Bench::request(0x100)), b.w(true, 0, 0x1, false), b.edge();
         b.w(true, 0, 0x3), b.edge();
         b.b(), b.edge();
       }},
      {"AXI4_ERRM_WLAST_STABLE", [](Bench& b) {
         b.aw(Bench::request(0x100)), b.w(false, 0, 0xF, false), b.edge();
         b.w(true), b.edge();
         b.b(), b.edge();
       }}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_rule_is_broken_alone) {
  std::vector<Breach> all = breaches();
  for (Breach& breach : breaches_of_answers()) all.push_back(std::move(breach));
  for (const Breach& breach : all) {
    Bench bench;
    breach.act(bench);
    BOOST_TEST(bench.broken() == breach.rule);
  }
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
