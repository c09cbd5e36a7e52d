// The interrupt controller's registers, as a program on the bus sees them.
#include <vp/report.h>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "gic_bench.h"

using namespace bench;
using namespace bench::gic_at_bus;

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

BOOST_AUTO_TEST_SUITE_END()
