// AXI VDMA: frames from memory and into it, their order, and what is wrong with a stream.
#include <boost/test/unit_test.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <xilinx/axi_vdma/axi_vdma.h>
#include "bus_master.h"
#include "memory_target.h"

using kit::BusMaster;

namespace {

using namespace axi_vdma;

constexpr std::uint64_t period = 10'000;  // ps: 100 MHz
constexpr std::uint32_t store_size = 0x400, lines = 4, line_bytes = 24, stride = 32;
constexpr std::size_t memory_size = 0x4000;

/// A camera: offers what it is given, with TUSER.
class Camera : public vp::Clocked {
 public:
  Camera(sc_core::sc_module_name name, vp::Clock& clock, unsigned bytes) : Clocked(name, clock) {
    vp::StreamShape shape{this->name(), bytes};
    shape.user = 1;
    m_axis.set_shape(shape);
    bytes_ = bytes;
  }
  vp::AxiStreamMaster m_axis{"m_axis", *this};

  /// A frame whose byte i of line n is `first` + n * 16 + i.
  void send(unsigned count, unsigned bytes, unsigned first) {
    for (unsigned line = 0; line < count; ++line) {
      for (unsigned at = 0; at < bytes; at += bytes_)
        beats_.push_back({first + line * 16 + at, line == 0 && at == 0, at + bytes_ >= bytes});
    }
    wake();
  }
  bool idle() const { return beats_.empty() && !m_axis.tvalid.get(); }

 private:
  struct Beat {
    unsigned first;
    bool starts, last;
  };
  void edge() override {
    if (!m_axis.free()) return;
    if (beats_.empty()) {
      m_axis.withdraw();
      return sleep();
    }
    const Beat beat = beats_.front();
    beats_.pop_front();
    vp::StreamBytes bytes;
    for (unsigned i = 0; i < bytes_; ++i) {
      bytes.data[i] = static_cast<unsigned char>(beat.first + i);
      bytes.keep.set(i);
    }
    for (auto& part : m_axis.link().parts())
      if (part.part.field == vp::StreamField::user) part.wire = beat.starts ? 1 : 0;
    m_axis.offer(bytes, beat.last);
  }
  unsigned bytes_;
  std::deque<Beat> beats_;
};

struct Bench : kit::Simulation {
  explicit Bench(const xilinx::AxiVdmaBuild& build) : vdma("vdma", lite, clock, clock, build) {
    reports.redirect(text);
    master.socket.bind(vdma.s_axi_lite.socket);
    if (vdma.mm2s()) {
      memory = std::make_unique<kit::MemoryTarget>("memory", memory_size);
      vdma.mm2s()->m_axi.link.socket.bind(memory->socket);
    }
    if (vdma.s2mm()) vdma.s2mm()->m_axi.link.socket.bind(written.socket);
  }
  bool said(const char* words) const { return text.str().find(words) != std::string::npos; }
  std::uint64_t now() const { return scheduler.now_ps() / period; }
  void wait(std::uint64_t clocks) { BusMaster::wait_until(scheduler.now_ps() + clocks * period); }

  void start(const ChannelOffsets& channel, std::uint32_t control) {
    for (std::uint32_t i = 0; i < 3; ++i)
      master.write(channel.first_address + 4 * i, i * store_size);
    master.write(channel.control, control | vdmacr::RS);
    BOOST_TEST((master.read(channel.status) & vdmasr::Halted) == 0u);
    master.write(channel.stride, stride);
    master.write(channel.hsize, line_bytes);
    master.write(channel.vsize, lines);
  }
  unsigned char at(std::uint32_t store, std::uint32_t line, std::uint32_t byte) {
    return written.data()[store * store_size + line * stride + byte];
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock lite{"lite", scheduler, 50'000'000};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  BusMaster master{"master"};
  std::unique_ptr<kit::MemoryTarget> memory;  ///< that is read; null: nothing reads
  kit::MemoryTarget written{"written", memory_size};
  xilinx::AxiVdma vdma;
  std::ostringstream text;
  vp::ReportRouter reports;
};

xilinx::AxiVdmaBuild both(xilinx::GenlockMode reads, xilinx::GenlockMode writes) {
  xilinx::AxiVdmaBuild build;
  build.mm2s.genlock = reads;
  build.s2mm.genlock = writes;
  build.mm2s.stream_bytes = build.s2mm.stream_bytes = 3;
  return build;
}

xilinx::AxiVdmaBuild writer_only() {
  xilinx::AxiVdmaBuild build = both(xilinx::GenlockMode::master, xilinx::GenlockMode::master);
  build.mm2s.include = false;
  return build;
}

constexpr std::uint32_t circular = vdmacr::Circular_Park | 1u << 16;

}  // namespace

BOOST_AUTO_TEST_SUITE(axi_vdma)

BOOST_AUTO_TEST_CASE(frames_pass_from_memory_to_memory) {
  for (const bool direct : {true, false}) {
    Bench b(both(xilinx::GenlockMode::master, xilinx::GenlockMode::master));
    b.memory->allow_dmi = b.written.allow_dmi = direct;
    vp::AxiStream link("link");
    b.vdma.mm2s()->m_axis(link);
    b.vdma.s2mm()->s_axis(link);
    for (std::uint32_t i = 0; i < 0x1000; ++i)
      b.memory->data()[i] = static_cast<unsigned char>(i * 7 + (i >> 8));
    std::uint64_t began = 0, first = 0, second = 0;
    b.master.simulate([&] {
      BOOST_TEST(b.vdma.s2mm()->under_way() == "");
      b.start(s2mm, circular | vdmacr::FrmCnt_IrqEn);
      b.start(mm2s, circular);
      began = b.now();
      const auto next_interrupt = [&] {
        while (!b.vdma.s2mm_introut.get()) b.wait(1);
        BOOST_TEST((b.master.read(s2mm.status) & vdmasr::FrmCnt_Irq) != 0u);
        b.master.write(s2mm.status, vdmasr::FrmCnt_Irq);
        BOOST_TEST(!b.vdma.s2mm_introut.get());
        return b.now();
      };
      first = next_interrupt();
      second = next_interrupt();
      while (b.vdma.s2mm()->frames.get() < 3) b.wait(1);
      const std::string frame = " frames of " + std::to_string(lines) + " lines of " +
                                std::to_string(line_bytes) + " bytes, ";
      BOOST_TEST(b.vdma.s2mm()->under_way() == "S2MM was writing" + frame + "3 of them so far,");
      BOOST_TEST(b.vdma.mm2s()->under_way().find("MM2S was sending" + frame) == 0u);
      b.master.write(mm2s.control, circular);
      b.wait(200);
      BOOST_TEST((b.master.read(mm2s.status) & vdmasr::Halted) != 0u);
      BOOST_TEST(b.vdma.mm2s()->under_way() == "");
    });
    for (std::uint32_t store = 0; store < 3; ++store) {
      for (std::uint32_t line = 0; line < lines; ++line) {
        for (std::uint32_t i = 0; i < stride; ++i) {
          const std::uint32_t at = store * store_size + line * stride + i;
          BOOST_REQUIRE(b.at(store, line, i) == (i < line_bytes ? b.memory->data()[at] : 0));
        }
      }
    }
    BOOST_TEST(link.packets.get() >= 3u * lines);
    // A clock to begin, 14 to the address, 24 to the first beat, 32 beats, 16 to the last burst, 3
    // for its words, 11 to the end. Then 8, 14, 24 and 32 from frame to frame.
    if (direct) {
      BOOST_TEST(first - began == 101u);
      BOOST_TEST(second - first == 78u);
    }
  }
}

BOOST_AUTO_TEST_CASE(registers_after_reset_are_those_of_the_build) {
  Bench b(both(xilinx::GenlockMode::dynamic_slave, xilinx::GenlockMode::dynamic_master));
  vp::AxiStream link("link");
  b.vdma.mm2s()->m_axis(link);
  b.vdma.s2mm()->s_axis(link);
  b.master.simulate([&] {
    BOOST_TEST(b.master.read(mm2s.control) == 0x00010082u);
    BOOST_TEST(b.master.read(s2mm.status) == 0x00010001u);
    BOOST_TEST(b.master.read(VDMA_VERSION) == 0x62000050u);
    b.master.write(s2mm.control, 0x00000002);  // no count of frames: it is 1
    BOOST_TEST(b.master.read(s2mm.control) == 0x00010002u);
    b.master.write(PARK_PTR_REG, 0x0201);
    BOOST_TEST(b.master.read(PARK_PTR_REG) == 0x0201u);
    b.master.write(s2mm.stride, 0x05000020);
    BOOST_TEST(b.master.read(s2mm.stride) == 0x20u);  // the delay is a plain slave's
    b.master.write(s2mm.control, vdmacr::Reset);
    BOOST_TEST(b.master.read(s2mm.control) == 0x00010082u);
    BOOST_TEST(b.master.read(s2mm.stride) == 0u);
  });
}

BOOST_AUTO_TEST_CASE(a_channel_that_is_not_built_reads_0) {
  Bench b(writer_only());
  xilinx::AxiVdmaBuild nothing = writer_only();
  nothing.s2mm.include = false;
  BOOST_CHECK_THROW(xilinx::AxiVdma("none", b.lite, b.clock, b.clock, nothing), vp::InputError);
  vp::AxiStream link("link");
  Camera camera("camera", b.clock, 3);
  camera.m_axis(link);
  b.vdma.s2mm()->s_axis(link);
  b.master.simulate([&] {
    BOOST_TEST(b.master.read(mm2s.control) == 0u);
    BOOST_TEST(b.master.read(mm2s.status) == 0u);
  });
}

BOOST_AUTO_TEST_CASE(lines_and_frames_of_another_size_are_reported_and_passed_over) {
  Bench b(writer_only());
  vp::AxiStream link("link");
  Camera camera("camera", b.clock, 3);
  camera.m_axis(link);
  b.vdma.s2mm()->s_axis(link);
  const auto status_after = [&](unsigned count, unsigned bytes, unsigned first) {
    camera.send(count, bytes, first);
    while (!camera.idle()) b.wait(1);
    b.wait(100);
    const std::uint32_t status = b.master.read(s2mm.status);
    b.master.write(s2mm.status, vdmasr::cleared_by_1);
    return status & (vdmasr::cleared_by_1 & ~vdmasr::FrmCnt_Irq);
  };
  b.master.simulate([&] {
    b.start(s2mm, circular | vdmacr::Err_IrqEn);
    BOOST_TEST(status_after(lines, line_bytes, 1) == 0u);
    BOOST_TEST(status_after(lines, line_bytes + 3, 2) == (vdmasr::EOLLateErr | vdmasr::Err_Irq));
    BOOST_TEST(status_after(lines, line_bytes - 3, 3) == (vdmasr::EOLEarlyErr | vdmasr::Err_Irq));
    BOOST_TEST(status_after(lines + 1, line_bytes, 4) == (vdmasr::SOFLateErr | vdmasr::Err_Irq));
    BOOST_TEST(status_after(lines - 1, line_bytes, 5) == 0u);
    BOOST_TEST(status_after(lines, line_bytes, 6) == (vdmasr::SOFEarlyErr | vdmasr::Err_Irq));
    b.master.write(S2MM_VDMA_IRQ_MASK, 0x8);
    BOOST_TEST(status_after(lines, line_bytes + 3, 7) == vdmasr::EOLLateErr);
    BOOST_TEST(!b.vdma.s2mm_introut.get());
  });
  BOOST_TEST(b.at(1, lines - 1, line_bytes - 1) ==
             2 + 16 * (lines - 1) + line_bytes - 1);  // whole in spite of the long lines
  BOOST_TEST(b.vdma.s2mm()->frames.get() == 6u);
  for (const char* words : {"EOLLateErr", "EOLEarlyErr", "SOFLateErr", "SOFEarlyErr"})
    BOOST_TEST(b.said(words));
}

BOOST_AUTO_TEST_CASE(a_parked_channel_keeps_its_frame_store) {
  Bench b(writer_only());
  vp::AxiStream link("link");
  Camera camera("camera", b.clock, 3);
  camera.m_axis(link);
  b.vdma.s2mm()->s_axis(link);
  b.master.simulate([&] {
    b.master.write(PARK_PTR_REG, 2u << 8);
    b.start(s2mm, 2u << 16 | vdmacr::FrameCntEn);
    for (const unsigned first : {10u, 20u, 30u}) camera.send(lines, line_bytes, first);
    b.wait(500);
    BOOST_TEST(b.master.read(PARK_PTR_REG) == (2u << 24 | 2u << 8));
    // It halts behind two frames; the third waits.
    BOOST_TEST((b.master.read(s2mm.status) & vdmasr::Halted) != 0u);
    BOOST_TEST(!camera.idle());
  });
  BOOST_TEST(b.at(2, 0, 0) == 20u);
  BOOST_TEST(b.at(0, 0, 0) == 0u);
}

BOOST_AUTO_TEST_CASE(a_reader_that_is_locked_shows_the_newest_frame) {
  Bench b(both(xilinx::GenlockMode::dynamic_slave, xilinx::GenlockMode::dynamic_master));
  vp::AxiStream from("from"), to("to");
  Camera camera("camera", b.clock, 3);
  vp::StreamSink screen("screen", b.clock);
  screen.ready_on = [](std::uint64_t cycle) { return cycle % 2 == 0; };
  vp::StreamShape shape{"screen", 3};
  shape.user = 1;
  screen.s_axis.set_shape(shape);
  camera.m_axis(from);
  b.vdma.s2mm()->s_axis(from);
  b.vdma.mm2s()->m_axis(to);
  screen.s_axis(to);
  std::set<std::uint32_t> shown;
  b.master.simulate([&] {
    const std::uint32_t locked = circular | vdmacr::GenlockEn | vdmacr::GenlockSrc;
    b.start(s2mm, locked);
    camera.send(lines, line_bytes, 1);
    b.wait(150);
    b.start(mm2s, locked);
    const xilinx::VdmaChannel &reads = *b.vdma.mm2s(), &writes = *b.vdma.s2mm();
    for (unsigned frame = 2; frame < 14; ++frame) {
      camera.send(lines, line_bytes, frame);
      for (unsigned clocks = 0; clocks < 97; ++clocks) {
        b.wait(1);
        if (!reads.in_frame()) continue;
        shown.insert(reads.store());
        // What is written is not read.
        BOOST_REQUIRE((!writes.in_frame() || reads.store() != writes.store()));
      }
    }
  });
  BOOST_TEST(shown.size() == 3u);
}

BOOST_AUTO_TEST_CASE(orders_that_make_no_sense_and_memory_that_refuses) {
  Bench b(writer_only());
  vp::AxiStream link("link");
  Camera camera("camera", b.clock, 3);
  camera.m_axis(link);
  b.vdma.s2mm()->s_axis(link);
  b.written.allow_dmi = false;
  b.written.answer = tlm::TLM_ADDRESS_ERROR_RESPONSE;
  b.master.simulate([&] {
    const std::uint32_t control = circular | vdmacr::RS | vdmacr::Err_IrqEn;
    b.master.write(s2mm.control, control);
    b.master.write(s2mm.vsize, lines);  // HSIZE is 0
    BOOST_TEST((b.master.read(s2mm.status) & (vdmasr::VDMAIntErr | vdmasr::Halted)) ==
               (vdmasr::VDMAIntErr | vdmasr::Halted));
    BOOST_TEST(b.vdma.s2mm_introut.get());
    b.master.write(s2mm.control, vdmacr::Reset);
    BOOST_TEST(!b.vdma.s2mm_introut.get());
    b.master.write(s2mm.control, control);
    b.master.write(s2mm.first_address, 0x101);  // no realignment
    b.master.write(s2mm.hsize, line_bytes);
    b.master.write(s2mm.stride, stride);
    b.master.write(s2mm.vsize, lines);
    BOOST_TEST((b.master.read(s2mm.status) & vdmasr::VDMAIntErr) != 0u);
    b.master.write(s2mm.control, vdmacr::Reset);
    b.start(s2mm, circular);
    camera.send(lines, line_bytes, 0);
    b.wait(200);
    BOOST_TEST((b.master.read(s2mm.status) & (vdmasr::VDMADecErr | vdmasr::Halted)) ==
               (vdmasr::VDMADecErr | vdmasr::Halted));
  });
  BOOST_TEST(b.said("START_ADDRESS1 is no multiple of 8 bytes"));
  BOOST_TEST(b.said("VSIZE or HSIZE is 0"));
  BOOST_TEST(b.said("is out of reach of its memory port"));
}

BOOST_AUTO_TEST_SUITE_END()
