#include <xilinx/axi_cdma/axi_cdma.h>

#include <algorithm>
#include <string>

#include <vp/report.h>
#include <vp/text.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using namespace axi_cdma;

constexpr std::uint32_t boundary = 4096;  // AXI: a burst never crosses it

}  // namespace

AxiCdma::AxiCdma(sc_core::sc_module_name name, vp::Clock& s_axi_aclk, const AxiCdmaBuild& build)
    : Clocked(name, s_axi_aclk),
      Ip(&s_axi_aclk),
      burst_beats("burst_beats", build.burst_beats, vp::Unit::none, {2, 256}, vp::Source::published,
                  "build option Maximum Burst Length (PG034)"),
      memory_bytes("memory_bytes", build.memory_bytes, vp::Unit::bytes, {4, 128},
                   vp::Source::published, "build option Write/Read Data Width, in bytes (PG034)"),
      start_clocks("start_clocks", 16, vp::Unit::cycles, {1, 1000}, vp::Source::assumed,
                   "BTT to the first address: register, command and the DataMover's 8 (PG022)"),
      read_clocks("read_clocks", 20, vp::Unit::cycles, {0, 1000}, vp::Source::published,
                  "address to first word from the DDR through HP (pynqz2-ram-tester)"),
      s_axi_lite("s_axi_lite", axi_cdma::registers, axi_lite_options(axi_cdma::address_bits),
                 &s_axi_aclk.scheduler()),
      m_axi("m_axi", s_axi_aclk.scheduler()),
      cr_(s_axi_lite[CDMACR]),
      sr_(s_axi_lite[CDMASR]),
      sa_(s_axi_lite[SA]),
      da_(s_axi_lite[DA]),
      btt_(s_axi_lite[BTT]) {
  wire();
}

// The guide's table has about 750 LUT and 1000 FF for simple mode. DataMover: 150 MHz (PG022, -1).
vp::IpEstimate AxiCdma::own_estimate() const {
  vp::IpEstimate e = axi_estimate("axi_cdma", 750, 1000, 1);
  e.fmax_hz = 150'000'000;
  e.active_clocks = [this] {
    return clocks_per_access * accesses(s_axi_lite) + m_axi.link.bytes_read / memory_bytes;
  };
  return e;
}

void AxiCdma::wire() {
  cr_.after_write([this](std::uint32_t word) {
    if ((word & cdmacr::Reset) != 0) reset();
    update();
  });
  sr_.after_write([this](std::uint32_t) { update(); });
  btt_.after_write([this](std::uint32_t) { start(); });
}

void AxiCdma::start() {
  if (state_ != State::idle) {
    vp::warn(*this, "/markervp/axi_cdma/busy",
             "BTT written during a transfer: ignored; wait for CDMASR.Idle first");
    return;
  }
  if (btt_ == 0 || (sa_ | da_) % memory_bytes != 0) {
    vp::warn(*this, "/markervp/axi_cdma/order",
             "a transfer of 0 bytes, or one whose addresses are no multiples of " +
                 std::to_string(memory_bytes) +
                 ", the bytes of a beat, which a build without realignment does not take "
                 "(DMAIntErr)");
    return fail(cdmasr::DMAIntErr);
  }
  sr_.clear_bits(cdmasr::Idle);
  done_bytes_ = 0;
  m_axi.orders.add(da_, cr_.any(cdmacr::Key_Hole_Write) ? memory_bytes.get() : btt_.value());
  take(State::starting, start_clocks + read_clocks);
  wake_at(done_at_);
}

void AxiCdma::fail(std::uint32_t error) {
  m_axi.orders.drop();
  sr_.set_bits(error | cdmasr::Err_Irq | cdmasr::Idle);
  state_ = State::idle;
  done_at_ = vp::Clock::never;
  update();
}

void AxiCdma::fail_on_bus(bool nothing_there) {
  const bool reads = state_ == State::reading;
  vp::warn(
      *this, "/markervp/axi_cdma/bus_error",
      std::string{reads ? "the source" : "the destination"} + ", " +
          vp::hex((reads ? sa_ : da_) + done_bytes_) +
          (nothing_there ? ", is out of reach of M_AXI (DECERR): see its addresses in the design"
                         : ", refuses the access (SLVERR)"));
  fail(nothing_there ? cdmasr::DMADecErr : cdmasr::DMASlvErr);
}

void AxiCdma::reset() {
  s_axi_lite.reset();
  m_axi.orders.drop();
  state_ = State::idle;
  done_at_ = vp::Clock::never;
}

void AxiCdma::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (s_axi_aresetn.bound()) s_axi_aresetn.signal()->attach(*this);
}

void AxiCdma::on_change(vp::SignalBase&, std::uint32_t) {
  reset();
  s_axi_lite.hold_in_reset(!s_axi_aresetn);
  update();
}

void AxiCdma::take(State state, std::uint64_t clocks) {
  state_ = state;
  done_at_ = clock().cycle() + std::max<std::uint64_t>(1, clocks);
}

std::uint32_t AxiCdma::beats(std::uint32_t bytes) const {
  return (bytes + memory_bytes - 1) / memory_bytes;
}

void AxiCdma::read_burst() {
  const bool fixed = cr_.any(cdmacr::Key_Hole_Read);
  const std::uint32_t from = fixed ? sa_ : sa_ + done_bytes_, to = da_ + done_bytes_;
  burst_bytes_ = std::min({btt_ - done_bytes_, burst_beats * memory_bytes, most_burst_bytes,
                           boundary - from % boundary, boundary - to % boundary});
  m_axi.read(from, data_.data(), burst_bytes_, fixed);
  take(State::reading, beats(burst_bytes_));
}

void AxiCdma::write_burst() {
  const bool fixed = cr_.any(cdmacr::Key_Hole_Write);
  m_axi.write(fixed ? da_ : da_ + done_bytes_, data_.data(), burst_bytes_, fixed);
  take(State::writing, 1);
}

// The writing channel works while the next burst is read: its beats take no time of their own but
// for the last burst's.
void AxiCdma::burst_written() {
  done_bytes_ += burst_bytes_;
  if (done_bytes_ < btt_) return read_burst();
  m_axi.orders.end();
  sr_.set_bits(cdmasr::IOC_Irq | cdmasr::Idle);
  state_ = State::idle;
  done_at_ = vp::Clock::never;
}

void AxiCdma::edge() {
  sleep();
  if (done_at_ > clock().cycle()) return update();
  if (!m_axi.done()) {  // a memory that takes its own time
    done_at_ = clock().cycle() + 1;
    return update();
  }
  if (state_ == State::starting) {
    read_burst();
  } else if (m_axi.response() != tlm::TLM_OK_RESPONSE) {
    return fail_on_bus(m_axi.response() == tlm::TLM_ADDRESS_ERROR_RESPONSE);
  } else if (state_ == State::reading) {
    write_burst();
  } else if (state_ == State::writing) {
    burst_written();
  }
  update();
}

void AxiCdma::update() {
  const bool complete = sr_.any(cdmasr::IOC_Irq) && cr_.any(cdmacr::IOC_IrqEn);
  const bool failed = sr_.any(cdmasr::Err_Irq) && cr_.any(cdmacr::Err_IrqEn);
  cdma_introut = complete || failed;
  wake_at(done_at_);
}

}  // namespace xilinx
