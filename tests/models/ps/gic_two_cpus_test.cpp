// The interrupt controller as each of two CPUs sees it.
#include <boost/test/unit_test.hpp>

#include "gic_bench.h"

using namespace bench;
using namespace bench::gic_at_bus;

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
