// The interrupt controller's registers, as a program on the bus sees them.
#include <gic_registers.h>

#include <ps/gic/gic.h>
#include <vp/report.h>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "bench.h"

using namespace bench;

namespace {

constexpr std::uint32_t icc = gic::cpu_interface_base;
constexpr std::uint32_t icd = gic::distributor_base;

struct GicBench : Bench {
  GicBench() {
    bus.map("gic_cpu_interface", icc, 0x100).bind(gic.cpu_interface.socket);
    bus.map("gic_distributor", icd, 0x1000).bind(gic.distributor.socket);
    gic.irq_f2p(irq_f2p);
    gic.connect(gic::global_timer_id, timer);
  }
  vp::Signal<std::uint32_t> irq_f2p{"irq_f2p", 16};
  vp::Signal<bool> timer{"timer"};
  ps::Gic gic{"gic", scheduler};

  bool irq() const { return !gic.n_irq.get(); }
};

void change(std::uint32_t address, std::uint32_t mask, std::uint32_t bits) {
  hal_write32(address, (hal_read32(address) & ~mask) | bits);
}

/// What the driver does, for one interrupt of this CPU. Private interrupts have their target and
/// sensitivity by nature.
void set_up(std::uint32_t id, std::uint32_t priority = 0xA0, bool edge = false) {
  hal_write32(icd + gic::ICDDCR, 1);
  hal_write32(icc + gic::ICCPMR, 0xF0);
  hal_write32(icc + gic::ICCICR, 7);
  const unsigned byte = 8 * (id % 4);
  change(icd + gic::ICDIPR(id / 4), 0xFFu << byte, priority << byte);
  if (id >= gic::first_spi) {
    change(icd + gic::ICDIPTR(id / 4), 0xFFu << byte, 1u << byte);
    const unsigned pair = 2 * (id % 16);
    const std::uint32_t sense = edge ? gic::icdicfr::rising_edge : gic::icdicfr::level_high;
    change(icd + gic::ICDICFR(id / 16), 3u << pair, sense << pair);
  }
  hal_write32(icd + gic::ICDISER(id / 32), 1u << (id % 32));
}

std::uint32_t acknowledge() {
  return hal_read32(icc + gic::ICCIAR);
}
void end(std::uint32_t id) {
  hal_write32(icc + gic::ICCEOIR, id);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(gic_test)

BOOST_AUTO_TEST_CASE(reset_values) {
  GicBench b;
  b.run([] {
    for (const auto& r : gic::cpu_interface_registers) {
      BOOST_TEST(hal_read32(icc + r.offset) == (r.access == vp::Access::write_only ? 0 : r.reset),
                 r.name);
    }
    for (const auto& r : gic::distributor_registers) {
      BOOST_TEST(hal_read32(icd + r.offset) == (r.access == vp::Access::write_only ? 0 : r.reset),
                 r.name);
    }
    BOOST_TEST(hal_read32(icd + 0xF80) == 0u);  // reserved
    return 0;
  });
  BOOST_TEST(!b.irq());
  BOOST_TEST(b.gic.n_fiq.get());
}

BOOST_AUTO_TEST_CASE(writable_bits) {
  GicBench b;
  vp::ReportRouter reports(sc_core::SC_NONE);
  std::ostringstream text;
  reports.redirect(text);
  b.run([] {
    const auto ones_read_back = [](std::uint32_t address) {
      hal_write32(address, 0xFFFF'FFFF);
      return hal_read32(address);
    };
    BOOST_TEST(ones_read_back(icc + gic::ICCICR) == 0x1Fu);
    BOOST_TEST(ones_read_back(icc + gic::ICCPMR) == 0xF8u);
    BOOST_TEST(ones_read_back(icc + gic::ICCBPR) == 7u);
    hal_write32(icc + gic::ICCBPR, 0);
    BOOST_TEST(hal_read32(icc + gic::ICCBPR) == 2u);
    hal_write32(icc + gic::ICCABPR, 0);
    BOOST_TEST(hal_read32(icc + gic::ICCABPR) == 3u);
    BOOST_TEST(ones_read_back(icc + gic::ICCIIDR) == 0x3901'243Bu);
    BOOST_TEST(ones_read_back(icd + gic::ICDDCR) == 3u);
    BOOST_TEST(ones_read_back(icd + gic::ICDISR(1)) == 0xFFFF'FFFFu);
    BOOST_TEST(ones_read_back(icd + gic::ICDISER(0)) == 0xFFFF'FFFFu);
    BOOST_TEST(hal_read32(icd + gic::ICDICER(0)) == 0xFFFF'FFFFu);
    hal_write32(icd + gic::ICDICER(0), 0xFFFF'FFFF);
    BOOST_TEST(hal_read32(icd + gic::ICDISER(0)) == 0xFFFFu);  // software interrupts stay enabled
    BOOST_TEST(ones_read_back(icd + gic::ICDISER(2)) == 0xFFFF'FFFFu);
    hal_write32(icd + gic::ICDICER(2), 0xF0);
    BOOST_TEST(hal_read32(icd + gic::ICDISER(2)) == 0xFFFF'FF0Fu);
    BOOST_TEST(ones_read_back(icd + gic::ICDISPR(0)) == 0xFFFF'0000u);
    hal_write32(icd + gic::ICDICPR(0), 0x000F'0000);
    BOOST_TEST(hal_read32(icd + gic::ICDISPR(0)) == 0xFFF0'0000u);
    BOOST_TEST(ones_read_back(icd + gic::ICDABR(1)) == 0u);
    BOOST_TEST(ones_read_back(icd + gic::ICDIPR(15)) == 0xF8F8'F8F8u);
    BOOST_TEST(ones_read_back(icd + gic::ICDIPTR(0)) == 0x0101'0101u);
    BOOST_TEST(ones_read_back(icd + gic::ICDIPTR(15)) == 0x0303'0303u);
    BOOST_TEST(ones_read_back(icd + gic::ICDICFR(0)) == 0xAAAA'AAAAu);
    BOOST_TEST(ones_read_back(icd + gic::ICDICFR(1)) == 0x7DC0'0000u);
    BOOST_TEST(ones_read_back(icd + gic::ICDICFR(3)) == 0xFFFF'FFFFu);
    hal_write32(icd + gic::ICDICFR(3), 0);
    BOOST_TEST(hal_read32(icd + gic::ICDICFR(3)) == 0x5555'5555u);  // the lower bit of a pair is 1
    return 0;
  });
  BOOST_TEST(reports.count(sc_core::SC_WARNING) == 5u);  // writes to read-only registers
}

BOOST_AUTO_TEST_CASE(a_level_is_pending_as_long_as_it_is_high) {
  GicBench b;
  b.run([&] {
    set_up(61);
    b.irq_f2p = 1;
    BOOST_TEST(b.irq());
    BOOST_TEST(hal_read32(icd + gic::ICDISPR(1)) == 1u << 29);
    BOOST_TEST(hal_read32(icc + gic::ICCHPIR) == 61u);
    BOOST_TEST(acknowledge() == 61u);
    BOOST_TEST(!b.irq());  // active: not signalled again
    BOOST_TEST(hal_read32(icd + gic::ICDABR(1)) == 1u << 29);
    BOOST_TEST(hal_read32(icc + gic::ICCRPR) == 0xA0u);
    BOOST_TEST(acknowledge() == 1023u);
    end(61);
    BOOST_TEST(hal_read32(icc + gic::ICCRPR) == 0xFFu);
    BOOST_TEST(b.irq());  // still high
    BOOST_TEST(acknowledge() == 61u);
    b.irq_f2p = 0;
    end(61);
    BOOST_TEST(!b.irq());
    BOOST_TEST(hal_read32(icd + gic::ICDISPR(1)) == 0u);
    return 0;
  });
  BOOST_TEST(b.gic.acknowledged == 2u);
  BOOST_TEST(b.gic.spurious == 1u);
}

BOOST_AUTO_TEST_CASE(an_edge_is_latched_until_acknowledged) {
  GicBench b;
  b.run([&] {
    set_up(62, 0xA0, true);
    b.irq_f2p = 2;
    b.irq_f2p = 0;
    BOOST_TEST(b.irq());
    BOOST_TEST(acknowledge() == 62u);
    BOOST_TEST(hal_read32(icd + gic::ICDISPR(1)) == 0u);
    b.irq_f2p = 2;  // again, while active
    BOOST_TEST(!b.irq());
    end(62);
    BOOST_TEST(b.irq());
    hal_write32(icd + gic::ICDICPR(1), 1u << 30);
    BOOST_TEST(!b.irq());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_request_and_since_when) {
  GicBench b;
  b.run([&] {
    set_up(61);
    BOOST_TEST(b.gic.request().id == 1023u);
    hal_work(step, 100);
    hal_barrier();
    const std::uint64_t risen = now_ps();
    b.irq_f2p = 1;
    hal_work(step, 100);
    hal_barrier();
    BOOST_TEST(b.gic.request().id == 61u);
    BOOST_TEST(b.gic.request().since_ps == risen);
    b.irq_f2p = 0;
    BOOST_TEST(b.gic.request().id == 1023u);
    b.irq_f2p = 1;
    BOOST_TEST(b.gic.request().since_ps == now_ps());
    hal_write32(icd + gic::ICDISER(0), 1u << 5);
    hal_write32(icd + gic::ICDIPR(1), 0x10u << 8);
    hal_write32(icd + gic::ICDSGIR, 2u << 24 | 5u);
    BOOST_TEST(b.gic.request().id == 5u);
    BOOST_TEST(b.gic.request().since_ps == now_ps());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(an_edge_before_the_enable_is_not_lost) {
  GicBench b;
  b.run([&] {
    set_up(61, 0xA0, true);
    hal_write32(icd + gic::ICDICER(1), 1u << 29);
    b.irq_f2p = 1;
    b.irq_f2p = 0;
    BOOST_TEST(!b.irq());
    hal_write32(icd + gic::ICDISER(1), 1u << 29);
    BOOST_TEST(b.irq());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(every_gate_on_the_way_can_close) {
  GicBench b;
  b.run([&] {
    set_up(61);
    b.irq_f2p = 1;
    const auto blocked = [&](std::uint32_t address, std::uint32_t closed, std::uint32_t open) {
      BOOST_TEST(b.irq());
      hal_write32(address, closed);
      BOOST_TEST(!b.irq());
      BOOST_TEST(acknowledge() == 1023u);
      hal_write32(address, open);
    };
    blocked(icd + gic::ICDDCR, 0, 1);
    blocked(icc + gic::ICCICR, 0, 7);
    blocked(icc + gic::ICCPMR, 0xA0, 0xF0);  // strictly more urgent than the mask
    blocked(icc + gic::ICCPMR, 0x00, 0xA8);
    blocked(icd + gic::ICDIPTR(15), 0, 0x0000'0100);
    BOOST_TEST(b.irq());
    hal_write32(icd + gic::ICDICER(1), 1u << 29);
    BOOST_TEST(!b.irq());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_most_urgent_comes_first_of_equals_the_lowest) {
  GicBench b;
  b.run([&] {
    set_up(61, 0xA0);
    set_up(62, 0x40);
    set_up(84, 0x40);
    b.irq_f2p = 1u << 0 | 1u << 1 | 1u << 8;
    BOOST_TEST(acknowledge() == 62u);
    BOOST_TEST(!b.irq());  // 84 is as urgent as the running one, 61 less
    b.irq_f2p = 1u << 0 | 1u << 8;
    end(62);
    BOOST_TEST(acknowledge() == 84u);
    set_up(63, 0x10);
    b.irq_f2p = 1u << 0 | 1u << 8 | 1u << 2;
    BOOST_TEST(b.irq());  // more urgent than the running one
    BOOST_TEST(acknowledge() == 63u);
    BOOST_TEST(hal_read32(icc + gic::ICCRPR) == 0x10u);
    b.irq_f2p = 1;
    end(63);
    BOOST_TEST(hal_read32(icc + gic::ICCRPR) == 0x40u);
    end(84);
    BOOST_TEST(acknowledge() == 61u);
    return 0;
  });
}

// What is most urgent decides, even if its group is closed at the CPU interface: when its wire
// falls, the next one comes through.
BOOST_AUTO_TEST_CASE(a_wire_that_falls_uncovers_the_next) {
  GicBench b;
  b.run([&b] {
    set_up(61, 0x40);
    set_up(62, 0x80);
    change(icd + gic::ICDISR(1), 1u << 29, 1u << 29);  // 61 is non-secure
    hal_write32(icd + gic::ICDDCR, 3);
    hal_write32(icc + gic::ICCICR, gic::iccicr::EnableS);
    b.irq_f2p = 3;
    BOOST_TEST(!b.irq());
    b.irq_f2p = 2;
    BOOST_TEST(b.irq());
    BOOST_TEST(acknowledge() == 62u);
    BOOST_TEST(!b.irq());
    b.irq_f2p = 0;
    end(62);
    BOOST_TEST(!b.irq());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_binary_point_limits_preemption) {
  GicBench b;
  b.run([&] {
    set_up(61, 0x48);
    set_up(62, 0x40);
    hal_write32(icc + gic::ICCBPR, 3);  // the lowest priority bit does not count
    b.irq_f2p = 1;
    BOOST_TEST(acknowledge() == 61u);
    b.irq_f2p = 3;
    BOOST_TEST(!b.irq());
    hal_write32(icc + gic::ICCBPR, 2);
    BOOST_TEST(b.irq());
    return 0;
  });
}

/// Cortex-A9 MPCore TRM 3.2 and the offsets of the vendor's driver (xscugic_hw.h): 0xD00, 0xD04 ….
/// They show the wires, whatever their sensitivity, enabled or not.
BOOST_AUTO_TEST_CASE(status_registers_show_the_wires) {
  GicBench b;
  b.run([&] {
    const auto status = [](unsigned n) { return hal_read32(icd + gic::SPI_STATUS(n)); };
    b.timer = true;
    BOOST_TEST(hal_read32(icd + gic::PPI_STATUS) == 1u << (gic::global_timer_id - 16));
    for (unsigned bit = 0; bit < 16; ++bit) {
      const std::uint32_t id = bit < 8 ? 61 + bit : 84 + (bit - 8);
      b.irq_f2p = 1u << bit;
      BOOST_TEST(status(0) == (id < 64 ? 1u << (id - 32) : 0u), "wire " << bit);
      BOOST_TEST(status(1) == (id < 64 ? 0u : 1u << (id - 64)), "wire " << bit);
    }
    // An edge that was latched is not a level.
    b.irq_f2p = 1;
    hal_write32(icd + gic::ICDICFR(3), 0xFFFF'FFFF);
    b.irq_f2p = 0;
    BOOST_TEST(status(0) == 0u);
    b.timer = false;
    BOOST_TEST(hal_read32(icd + gic::PPI_STATUS) == 0u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(all_sixteen_wires_of_the_pl) {
  GicBench b;
  b.run([&] {
    for (unsigned bit = 0; bit < 16; ++bit) {
      const std::uint32_t id = bit < 8 ? 61 + bit : 84 + bit - 8;
      set_up(id);
      b.irq_f2p = 1u << bit;
      BOOST_TEST(acknowledge() == id);
      b.irq_f2p = 0;
      end(id);
    }
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(software_interrupts) {
  GicBench b;
  b.run([&] {
    set_up(5);
    hal_write32(icd + gic::ICDSGIR, 1u << 16 | 5);
    BOOST_TEST(acknowledge() == 5u);
    end(5);
    hal_write32(icd + gic::ICDSGIR, 2u << 24 | 6);  // to itself
    BOOST_TEST(acknowledge() == 6u);
    end(6);
    hal_write32(icd + gic::ICDSGIR, 2u << 16 | 5);  // to the other CPU
    hal_write32(icd + gic::ICDSGIR, 1u << 24 | 5);  // to all others
    BOOST_TEST(acknowledge() == 1023u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(a_private_interrupt_with_its_fixed_edge) {
  GicBench b;
  b.run([&] {
    set_up(27);
    b.timer = true;
    BOOST_TEST(acknowledge() == 27u);
    end(27);
    BOOST_TEST(!b.irq());  // edge sensitive: a level that stays is no second interrupt
    b.timer = false;
    b.timer = true;
    BOOST_TEST(b.irq());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(pending_by_software) {
  GicBench b;
  b.run([&] {
    set_up(61);
    hal_write32(icd + gic::ICDISPR(1), 1u << 29);
    BOOST_TEST(acknowledge() == 61u);
    end(61);
    BOOST_TEST(!b.irq());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(non_secure_interrupts_need_ack_ctl) {
  GicBench b;
  b.run([&] {
    set_up(61);
    hal_write32(icd + gic::ICDISR(1), 1u << 29);
    b.irq_f2p = 1;
    BOOST_TEST(!b.irq());
    hal_write32(icd + gic::ICDDCR, 3);
    BOOST_TEST(b.irq());
    hal_write32(icc + gic::ICCICR, 3);
    BOOST_TEST(acknowledge() == 1022u);
    BOOST_TEST(hal_read32(icc + gic::ICCHPIR) == 1022u);
    hal_write32(icc + gic::ICCICR, 7);
    BOOST_TEST(acknowledge() == 61u);
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(non_secure_interrupts_are_never_fiq) {
  GicBench b;
  b.run([&] {
    set_up(61);
    hal_write32(icd + gic::ICDISR(1), 1u << 29);
    hal_write32(icd + gic::ICDDCR, 3);
    hal_write32(icc + gic::ICCICR, 0xF);
    b.irq_f2p = 1;
    BOOST_TEST(b.irq());
    BOOST_TEST(b.gic.n_fiq.get());
    return 0;
  });
}

// The binary point of non-secure interrupts counts one bit less: 3 looks at all five bits.
BOOST_AUTO_TEST_CASE(non_secure_interrupts_have_a_binary_point_of_their_own) {
  GicBench b;
  b.run([&] {
    set_up(61, 0x48);
    set_up(62, 0x40);
    hal_write32(icd + gic::ICDISR(1), 3u << 29);
    hal_write32(icd + gic::ICDDCR, 3);
    b.irq_f2p = 1;
    BOOST_TEST(acknowledge() == 61u);
    b.irq_f2p = 3;
    hal_write32(icc + gic::ICCABPR, 3);
    BOOST_TEST(b.irq());
    hal_write32(icc + gic::ICCABPR, 4);
    BOOST_TEST(!b.irq());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(an_interrupt_for_the_other_processor_only_does_not_come) {
  GicBench b;
  b.run([&] {
    set_up(61);
    b.irq_f2p = 1;
    const unsigned byte = 8 * (61 % 4);
    change(icd + gic::ICDIPTR(61 / 4), 0xFFu << byte, 2u << byte);
    BOOST_TEST(!b.irq());
    change(icd + gic::ICDIPTR(61 / 4), 0xFFu << byte, 3u << byte);
    BOOST_TEST(b.irq());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(secure_interrupts_as_fiq) {
  GicBench b;
  b.run([&] {
    set_up(61);
    b.irq_f2p = 1;
    hal_write32(icc + gic::ICCICR, 0xF);
    BOOST_TEST(!b.irq());
    BOOST_TEST(!b.gic.n_fiq.get());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(the_end_of_what_is_not_active_is_reported) {
  GicBench b;
  vp::ReportRouter reports(sc_core::SC_NONE);
  std::ostringstream text;
  reports.redirect(text);
  b.run([&] {
    end(61);
    end(95);
    end(1023);  // harmless: what a spurious acknowledge returned,
    end(1022);  // or one of a non-secure interrupt
    return 0;
  });
  BOOST_TEST(reports.count("/markervp/gic/eoi") == 2u);
}

BOOST_AUTO_TEST_CASE(reading_by_debugger_changes_nothing) {
  GicBench b;
  b.run([&] {
    set_up(61);
    b.irq_f2p = 1;
    std::uint32_t word = 0;
    tlm::tlm_generic_payload payload;
    payload.set_command(tlm::TLM_READ_COMMAND);
    payload.set_address(icc + gic::ICCIAR);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
    payload.set_data_length(4);
    payload.set_streaming_width(4);
    BOOST_TEST(b.cpu.m_axi.transport_debug(payload) == 4u);
    BOOST_TEST(word == 61u);
    BOOST_TEST(b.irq());
    return 0;
  });
}

BOOST_AUTO_TEST_CASE(inputs_that_do_not_exist) {
  GicBench b;
  vp::Signal<bool> wire("wire");
  BOOST_CHECK_THROW(b.gic.connect(5, wire), std::logic_error);
  BOOST_CHECK_THROW(b.gic.connect(96, wire), std::logic_error);
  BOOST_CHECK_THROW(b.gic.connect(gic::global_timer_id, wire), std::logic_error);
}

namespace {

struct SystemBench : GicBench {
  vp::In<bool>& wire() { return cpu.n_irq; }
  SystemBench() { cpu.n_irq(gic.n_irq); }
};

std::vector<std::uint64_t> served;

}  // namespace

BOOST_AUTO_TEST_CASE(from_the_wire_to_the_handler_and_back) {
  SystemBench b;
  served.clear();
  b.device.written = [&](std::uint32_t) { b.irq_f2p = 0; };
  sc_core::sc_spawn([&] {
    sc_core::wait(vp::from_ps(700'000));
    b.irq_f2p = 1;
  });
  b.run([] {
    set_up(61);
    hal_interrupt_connect(
        [](void*) {
          const std::uint32_t id = acknowledge();
          served.push_back(id);
          served.push_back(now_ps());
          hal_write32(device_address, 0);
          end(id);
        },
        nullptr);
    hal_interrupt_enable(true);
    hal_work(step, 1000);
    hal_barrier();
    return 0;
  });
  const std::vector<std::uint64_t> expected{61, 800'000};  // 100 cycles of entry
  BOOST_TEST(served == expected, boost::test_tools::per_element());
  BOOST_TEST(b.cpu.interrupts == 1u);
  BOOST_TEST(b.cpu.end_ps() == 1'180'000u);
}

BOOST_AUTO_TEST_SUITE_END()

namespace {

/// Two CPUs, each with its view of the controller.
struct TwoViews : GicBench {
  TwoViews() {
    cpu1.m_axi.socket.bind(bus1.socket);
    cpu1.n_irq(gic1.n_irq);
    bus1.map("device", device_address, 0x1000, vp::Router::Addresses::absolute).bind(bus.socket);
    bus1.map("gic_cpu_interface", icc, 0x100).bind(gic1.cpu_interface.socket);
    bus1.map("gic_distributor", icd, 0x1000).bind(gic1.distributor.socket);
    bus.map("boot", 0xFFFF'F000, 0x1000).bind(boot.socket);
    gic1.connect(gic::private_timer_id, timer1);
  }
  Device boot{"boot", scheduler};
  vp::Router bus1{"bus1"};
  vp::Signal<bool> timer1{"timer1"};
  ps::Gic gic1{"gic1", gic};
  ps::Cpu cpu1{"cpu1", cpu_clock, cpu};
  bool irq1() const { return !gic1.n_irq.get(); }
};

constexpr std::uint32_t raise_at(std::uint32_t cpus, std::uint32_t id) {
  return cpus << gic::icdsgir::CPUTargetList_shift | id;
}

constexpr std::uint32_t filtered(std::uint32_t filter, std::uint32_t id) {
  return filter << gic::icdsgir::TargetListFilter_shift | id;
}

/// What the second CPU does, between the two parts of the first one's program.
void (*second_part)();
template <class First, class Last>
void run_parts(TwoViews& b, First first, void (*second)(), Last last) {
  second_part = second;
  b.run([=] {
    first();
    hal_cpu_start(1, second_part);
    hal_work(step, 10'000);
    hal_barrier();
    last();
    return 0;
  });
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(gic_of_two_cpus, TwoViews)

BOOST_AUTO_TEST_CASE(private_registers_are_those_of_who_looks) {
  run_parts(
      *this, [] { set_up(3, 0x30); },
      [] {
        BOOST_TEST(hal_read32(icd + gic::ICDIPR(0)) == 0u);
        BOOST_TEST(hal_read32(icd + gic::ICDIPTR(0)) == 0x02020202u);
        BOOST_TEST(hal_read32(icc + gic::ICCPMR) == 0u);
        hal_write32(icd + gic::ICDIPR(0), 0x50000000);
        hal_write32(icd + gic::ICDISER(0), 1u << gic::private_timer_id);
      },
      [] {
        BOOST_TEST(hal_read32(icd + gic::ICDIPR(0)) == 0x30000000u);
        BOOST_TEST(hal_read32(icd + gic::ICDIPTR(0)) == 0x01010101u);
        BOOST_TEST(hal_read32(icd + gic::ICDISER(0)) == 0xFFFFu);
      });
}

BOOST_AUTO_TEST_CASE(shared_registers_are_the_same) {
  run_parts(
      *this,
      [] {
        hal_write32(icd + gic::ICDDCR, 1);
        hal_write32(icd + gic::ICDIPR(15), 0xA0);
      },
      [] {
        BOOST_TEST(hal_read32(icd + gic::ICDDCR) == 1u);
        BOOST_TEST(hal_read32(icd + gic::ICDIPR(15)) == 0xA0u);
        hal_write32(icd + gic::ICDIPTR(15), 0x0300);
        hal_write32(icd + gic::ICDISER(1), 1u << 29);
        hal_write32(icd + gic::ICDICFR(3), 3u << 26);
      },
      [] {
        BOOST_TEST(hal_read32(icd + gic::ICDIPTR(15)) == 0x0300u);
        BOOST_TEST(hal_read32(icd + gic::ICDISER(1)) == 1u << 29);
        BOOST_TEST(hal_read32(icd + gic::ICDICFR(3)) == (0x55555555u | 3u << 26));
      });
}

BOOST_AUTO_TEST_CASE(a_shared_interrupt_goes_to_one) {
  static TwoViews* b;
  b = this;
  run_parts(
      *this,
      [] {
        set_up(61);
        change(icd + gic::ICDIPTR(15), 0xFF00, 0x0300);
      },
      [] {
        hal_write32(icc + gic::ICCPMR, 0xF0);
        hal_write32(icc + gic::ICCICR, 7);
        b->irq_f2p = 1;
        BOOST_TEST(b->irq());
        BOOST_TEST(b->irq1());
        BOOST_TEST(acknowledge() == 61u);
        BOOST_TEST(!b->irq());
        BOOST_TEST(!b->irq1());
      },
      [] {
        BOOST_TEST(acknowledge() == gic::spurious_id);
        BOOST_TEST((hal_read32(icd + gic::ICDABR(1)) >> 29) == 1u);
        BOOST_TEST(hal_read32(icc + gic::ICCRPR) == 0xFFu);
        end(61);  // of the other one: nothing happens
        BOOST_TEST((hal_read32(icd + gic::ICDABR(1)) >> 29) == 1u);
      });
}

BOOST_AUTO_TEST_CASE(a_private_interrupt_stays_with_its_cpu) {
  static TwoViews* b;
  b = this;
  run_parts(
      *this, [] { set_up(gic::private_timer_id); },
      [] {
        b->timer1 = true;
        BOOST_TEST(!b->irq1());
        set_up(gic::private_timer_id);
        BOOST_TEST(b->irq1());
        BOOST_TEST(hal_read32(icd + gic::PPI_STATUS) == 1u << (gic::private_timer_id - 16));
      },
      [] {
        BOOST_TEST(!b->irq());
        BOOST_TEST(hal_read32(icd + gic::PPI_STATUS) == 0u);
      });
}

BOOST_AUTO_TEST_CASE(software_interrupts_say_who_raised_them) {
  static TwoViews* b;
  b = this;
  run_parts(
      *this,
      [] {
        set_up(5);
        hal_write32(icd + gic::ICDSGIR, raise_at(3, 5));  // to both
        BOOST_TEST(b->irq());
      },
      [] {
        set_up(5);
        BOOST_TEST(b->irq1());
        hal_write32(icd + gic::ICDSGIR, raise_at(3, 5));
        // From CPU 0 first, then from this one.
        BOOST_TEST(acknowledge() == 5u);
        end(5);
        BOOST_TEST(acknowledge() == (1u << gic::icciar::CPUID_shift | 5u));
        end(5);
        BOOST_TEST(acknowledge() == gic::spurious_id);
      },
      [] {
        BOOST_TEST(acknowledge() == 5u);
        end(5);
        BOOST_TEST(acknowledge() == (1u << gic::icciar::CPUID_shift | 5u));
        end(5 | 1u << gic::icciar::CPUID_shift);
        BOOST_TEST(!b->irq());
      });
}

BOOST_AUTO_TEST_CASE(software_interrupts_go_to_the_others_or_to_oneself) {
  static TwoViews* b;
  b = this;
  run_parts(
      *this, [] { set_up(2); },
      [] {
        set_up(2);
        hal_write32(icd + gic::ICDSGIR, filtered(gic::icdsgir::filter_others, 2));
        BOOST_TEST(b->irq());
        BOOST_TEST(!b->irq1());
        hal_write32(icd + gic::ICDSGIR, filtered(gic::icdsgir::filter_self, 2));
        BOOST_TEST(b->irq1());
        BOOST_TEST(acknowledge() == (1u << gic::icciar::CPUID_shift | 2u));
      },
      [] { BOOST_TEST(acknowledge() == (1u << gic::icciar::CPUID_shift | 2u)); });
}

// It stays pending there until the core starts and opens its interface.
BOOST_AUTO_TEST_CASE(a_software_interrupt_to_a_core_that_is_off) {
  static TwoViews* b;
  b = this;
  run_parts(
      *this,
      [] {
        set_up(7);
        hal_write32(icd + gic::ICDSGIR, raise_at(2, 7));
        BOOST_TEST(!b->irq());
        BOOST_TEST(!b->irq1());
        BOOST_TEST(b->cpu1.asleep.get());
      },
      [] {
        set_up(7);
        BOOST_TEST(acknowledge() == 7u);
      },
      [] {});
}

BOOST_AUTO_TEST_SUITE_END()

namespace {

/// IRQ_F2P[0] is high for `ps`; how often that was too short.
std::size_t short_pulses(GicBench& bench, std::uint64_t ps, bool edge, bool enabled = true) {
  std::ostringstream text;
  vp::ReportRouter reports;
  reports.redirect(text);
  bench.run([&] {
    if (enabled) set_up(61, 0xA0, edge);
    bench.irq_f2p = 1;
    sc_core::wait(sc_core::sc_time::from_value(ps));
    bench.irq_f2p = 0;
    return 0;
  });
  return reports.count("/markervp/rule/INTERRUPT_PULSE");
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_pulse_of_one_clock_is_too_short_for_a_level, GicBench) {
  BOOST_TEST(short_pulses(*this, 10'000, false) == 1u);
}
BOOST_FIXTURE_TEST_CASE(a_pulse_of_one_clock_is_long_enough_for_an_edge, GicBench) {
  BOOST_TEST(short_pulses(*this, 10'000, true) == 0u);
}
BOOST_FIXTURE_TEST_CASE(a_pulse_of_4_ns_is_too_short_for_an_edge, GicBench) {
  BOOST_TEST(short_pulses(*this, 4'000, true) == 1u);
}
BOOST_FIXTURE_TEST_CASE(a_level_that_software_can_have_ended_is_silent, GicBench) {
  BOOST_TEST(short_pulses(*this, 100'000, false) == 0u);
}
BOOST_FIXTURE_TEST_CASE(a_pulse_of_an_interrupt_that_is_not_enabled_is_silent, GicBench) {
  BOOST_TEST(short_pulses(*this, 10'000, false, false) == 0u);
}
