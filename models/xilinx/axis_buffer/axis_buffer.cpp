#include <xilinx/axis_buffer/axis_buffer.h>

#include <vp/error.h>
#include <xilinx/bram/bram.h>
#include <xilinx/common/axi_lite_ip.h>

#include <algorithm>
#include <string>
#include <utility>

namespace xilinx {

namespace {

constexpr std::uint32_t reset_pin = 1;
constexpr std::uint32_t distributed_depth = 64;  ///< deeper FIFOs are block memory (PG085)

std::uint32_t checked(const char* name, std::uint32_t bytes) {
  if (bytes >= 1 && bytes <= vp::most_stream_bytes) return bytes;
  throw vp::InputError(std::string(name) + ": streams of " + std::to_string(bytes) +
                       " bytes are not modelled, those of 1 to " +
                       std::to_string(vp::most_stream_bytes) + " are");
}

}  // namespace

AxisBuffer::AxisBuffer(sc_core::sc_module_name name, vp::Clock& aclk, const AxisBufferBuild& build)
    : Clocked(name, aclk),
      Ip(&aclk),
      depth("depth", build.depth, vp::Unit::none, {2, 1u << 16}, vp::Source::published,
            "beats that it holds (PG085)"),
      latency("latency", build.latency, vp::Unit::cycles, {1, 64}, vp::Source::assumed,
              "clocks from a beat in to that beat on offer"),
      in_bytes_(checked(this->name(), build.in_bytes)),
      out_bytes_(checked(this->name(), build.out_bytes)) {
  const std::string prefix = std::string(this->name()) + ".";
  const auto shape = [&](const char* end, std::uint32_t bytes) {
    return vp::StreamShape{prefix + end, bytes, build.strobe, build.user, build.id, build.dest};
  };
  s_axis.set_shape(shape("s_axis", in_bytes_));
  m_axis.set_shape(shape("m_axis", out_bytes_));
  if (in_bytes_ != out_bytes_ && (build.strobe + build.user + build.id + build.dest) != 0)
    throw vp::InputError(std::string(this->name()) +
                         ": a width converter with TSTRB, TUSER, TID or TDEST is not modelled");
  wake_on(s_axis.tvalid);
  wake_on(m_axis.tready);
}

void AxisBuffer::end_of_elaboration() {
  Clocked::end_of_elaboration();
  if (aresetn.bound()) aresetn.signal()->attach(*this, reset_pin);
  for (auto& from : s_axis.link().parts()) {
    const bool is_bytes =
        from.part.field == vp::StreamField::data || from.part.field == vp::StreamField::keep;
    for (auto& to : m_axis.link().parts()) {
      if (!is_bytes && to.part.field == from.part.field && to.part.low == from.part.low)
        aside_.push_back({&from.wire, &to.wire});
    }
  }
}

void AxisBuffer::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id != reset_pin) return Clocked::on_change(signal, id);
  wake();
}

void AxisBuffer::edge() {
  const std::uint64_t cycle = this_edge();
  if (m_axis.accepted()) beats_.pop_front();
  if (s_axis.sample()) take(cycle);
  if (aresetn.bound() && !aresetn) {
    beats_.clear();
    collected_ = {};
    count_ = 0;
    s_axis.tready = false;
    return m_axis.withdraw();
  }
  if (m_axis.free()) {
    offering_ = !beats_.empty() && beats_.front().ready <= cycle;
    if (offering_) {
      offer(beats_.front());
    } else {
      m_axis.withdraw();
    }
  }
  const std::size_t most = (in_bytes_ + out_bytes_ - 1) / out_bytes_ + (count_ != 0 ? 1 : 0);
  const bool ready = beats_.size() + most <= depth;
  s_axis.tready = ready;
  if (beats_.empty() && !s_axis.tvalid.read() && ready) sleep();
}

void AxisBuffer::take(std::uint64_t cycle) {
  Beat beat{s_axis.link().beat(), {}, s_axis.tlast.read(), cycle + latency - 1};
  for (const Side& side : aside_) beat.sides.push_back(side.from->get());
  if (in_bytes_ == out_bytes_) {
    beats_.push_back(std::move(beat));
  } else {
    convert(beat);
  }
}

void AxisBuffer::offer(const Beat& beat) {
  m_axis.offer(beat.bytes, beat.last);
  for (std::size_t i = 0; i < aside_.size(); ++i) *aside_[i].to = beat.sides[i];
}

// The last byte of a packet takes TLAST along; a last beat without bytes goes alone.
void AxisBuffer::convert(const Beat& beat) {
  bool moved = false;
  for (unsigned lane = 0; lane < in_bytes_; ++lane) {
    if (!beat.bytes.keep[lane]) continue;
    collected_.bytes.data[count_] = beat.bytes.data[lane];
    collected_.bytes.keep.set(count_);
    moved = true;
    if (++count_ == out_bytes_) push(collected_, beat.ready);
  }
  if (!beat.last) return;
  if (count_ == 0 && moved) {
    beats_.back().last = true;
  } else {
    collected_.last = true;
    push(collected_, beat.ready);
  }
}

void AxisBuffer::push(Beat beat, std::uint64_t ready) {
  beat.ready = ready;
  beats_.push_back(beat);
  collected_ = {};
  count_ = 0;
}

vp::IpEstimate AxisBuffer::own_estimate() const {
  const std::uint32_t bits = 9 * std::max(in_bytes_, out_bytes_) + 1;
  const bool deep = depth > distributed_depth;
  vp::IpEstimate e = axi_estimate("axis_buffer", 40 + (deep ? 40 : bits * depth / 32),
                                  40 + 2 * bits, deep ? block_ram_36(depth, bits) : 0);
  e.source = "assumed: registers of two beats, and distributed or block memory for the others";
  e.active_clocks = [this] { return s_axis.bound() ? s_axis.link().beats.get() : 0; };
  return e;
}

}  // namespace xilinx
