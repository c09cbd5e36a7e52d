#include <xilinx/axis_fan/axis_fan.h>

#include <algorithm>
#include <string>

#include <vp/error.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

constexpr std::size_t fan_slice_beats = 2;

/// Wires of TUSER on both sides, in the same order.
std::vector<vp::Signal<std::uint32_t>*> user_wires(vp::AxiStream& link) {
  std::vector<vp::Signal<std::uint32_t>*> wires;
  for (auto& part : link.parts())
    if (part.part.field == vp::StreamField::user) wires.push_back(&part.wire);
  return wires;
}

}  // namespace

AxisBroadcaster::AxisBroadcaster(sc_core::sc_module_name name, vp::Clock& aclk,
                                 std::uint32_t in_bytes, std::uint32_t out_bytes,
                                 std::uint32_t user, const std::vector<std::string>& remaps)
    : Clocked(name, aclk), Ip(&aclk), in_bytes_(in_bytes), out_bytes_(out_bytes) {
  const std::string own = this->name();
  s_axis.set_shape({own + ".s_axis", in_bytes, 0, user});
  wake_on(s_axis.tvalid);
  for (const std::string& remap : remaps) {
    const std::string end = "m_axis_" + std::to_string(outputs_.size());
    Output& output = outputs_.emplace_back(end.c_str(), *this);
    output.port.set_shape({own + "." + end, out_bytes, 0, user});
    wake_on(output.port.tready);
    if (remap.empty()) continue;
    output.bits = parse_remap(remap, own + ": " + end);
    const bool fits = std::all_of(output.bits.begin(), output.bits.end(), [&](const RemapBit& bit) {
      using From = RemapBit::From;
      return bit.from == From::zero || bit.from == From::one ||
             (bit.from == From::data && bit.bit < vp::bits_per_byte * in_bytes);
    });
    if (!fits || output.bits.size() != vp::bits_per_byte * out_bytes)
      throw vp::InputError(own + ": " + end + ": the remap must have " +
                           std::to_string(vp::bits_per_byte * out_bytes) +
                           " bits, of TDATA or constants, as wide as the output");
  }
}

void AxisBroadcaster::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (aresetn.bound()) aresetn.signal()->attach(*this);
  s_axis.tvalid.signal()->attach(*this);
  for (Output& output : outputs_) output.port.tready.signal()->attach(*this);
}

void AxisBroadcaster::edge() {
  for (Output& output : outputs_)
    if (output.port.accepted()) output.beats.pop_front();
  if (s_axis.sample())
    for (Output& output : outputs_) output.beats.push_back(copy_for(output));
  if (aresetn.bound() && !aresetn) {
    for (Output& output : outputs_) {
      output.beats.clear();
      output.port.excuse();
      output.port.withdraw();
    }
    s_axis.tready = false;
    return sleep();
  }
  bool full = false, busy = false;
  for (Output& output : outputs_) {
    full = full || output.beats.size() >= fan_slice_beats;
    busy = busy || !output.beats.empty();
    if (!output.port.free()) continue;
    if (output.beats.empty()) {
      output.port.withdraw();
      continue;
    }
    const Beat& beat = output.beats.front();
    const auto to = user_wires(output.port.link());
    for (std::size_t i = 0; i < std::min(beat.users.size(), to.size()); ++i) *to[i] = beat.users[i];
    output.port.offer(beat.bytes, beat.last);
  }
  s_axis.tready = !full;
  if (!busy && !s_axis.tvalid.read()) return sleep();
  wake();
}

AxisBroadcaster::Beat AxisBroadcaster::copy_for(const Output& output) {
  const vp::StreamBytes in = s_axis.link().beat();
  Beat beat;
  vp::StreamBytes& out = beat.bytes;
  for (unsigned lane = 0; lane < out_bytes_; ++lane) {
    out.keep[lane] = !output.bits.empty() || lane >= in_bytes_ || in.keep[lane];
    if (output.bits.empty()) out.data[lane] = lane < in_bytes_ ? in.data[lane] : 0;
  }
  for (std::size_t bit = 0; bit < output.bits.size(); ++bit) {
    const RemapBit& from = output.bits[bit];
    const bool one =
        from.from == RemapBit::From::one ||
        (from.from == RemapBit::From::data &&
         (in.data[from.bit / vp::bits_per_byte] >> from.bit % vp::bits_per_byte & 1) != 0);
    if (one)
      out.data[bit / vp::bits_per_byte] |=
          static_cast<unsigned char>(1u << bit % vp::bits_per_byte);
  }
  for (const auto* wire : user_wires(s_axis.link())) beat.users.push_back(wire->get());
  beat.last = s_axis.tlast.read();
  return beat;
}

vp::IpEstimate AxisBroadcaster::own_estimate() const {
  const auto outputs = static_cast<std::uint32_t>(outputs_.size());
  vp::IpEstimate e = axi_estimate("axis_broadcaster", 5 + 5 * outputs,
                                  2 * outputs * vp::bits_per_byte * out_bytes_, 0);
  e.source = "assumed: registers of two beats at each output";
  e.active_clocks = [this] { return s_axis.bound() ? s_axis.link().beats.get() : 0; };
  return e;
}

AxisCombiner::AxisCombiner(sc_core::sc_module_name name, vp::Clock& aclk, std::uint32_t inputs,
                           std::uint32_t bytes, std::uint32_t user, std::uint32_t leader)
    : Clocked(name, aclk), Ip(&aclk), bytes_(bytes), leader_(leader) {
  const std::string own = this->name();
  if (inputs < 2 || inputs * bytes > vp::most_stream_bytes || leader >= inputs)
    throw vp::InputError(own + ": two inputs or more are modelled, of 128 bytes together");
  for (std::uint32_t n = 0; n < inputs; ++n) {
    const std::string end = "s_axis_" + std::to_string(n);
    Input& input = inputs_.emplace_back(end.c_str(), *this);
    input.port.set_shape({own + "." + end, bytes, 0, user});
  }
  m_axis.set_shape({own + ".m_axis", inputs * bytes, 0, user});
}

void AxisCombiner::before_end_of_elaboration() {
  Clocked::before_end_of_elaboration();
  if (aresetn.bound()) aresetn.signal()->attach(*this);
  m_axis.tready.signal()->attach(*this);
  for (Input& input : inputs_) input.port.tvalid.signal()->attach(*this);
}

bool AxisCombiner::all_have_one() const {
  return std::none_of(inputs_.begin(), inputs_.end(),
                      [](const Input& input) { return input.beats.empty(); });
}

void AxisCombiner::edge() {
  for (Input& input : inputs_) {
    if (!input.port.sample()) continue;
    Beat beat{input.port.link().beat(), {}, input.port.tlast.read()};
    for (const auto* wire : user_wires(input.port.link())) beat.users.push_back(wire->get());
    input.beats.push_back(std::move(beat));
  }
  const bool in_reset = aresetn.bound() && !aresetn;
  if (in_reset) {
    for (Input& input : inputs_) input.beats.clear();
    m_axis.excuse();
    m_axis.withdraw();
  } else if (m_axis.free()) {
    if (all_have_one()) {
      offer();
    } else {
      m_axis.withdraw();
    }
  }
  bool busy = false;
  for (Input& input : inputs_) {
    input.port.tready = !in_reset && input.beats.size() < fan_slice_beats;
    busy = busy || input.port.tvalid.read();
  }
  if (in_reset || (!busy && !all_have_one() && !m_axis.tvalid.written())) return sleep();
  wake();
}

void AxisCombiner::offer() {
  vp::StreamBytes out;
  unsigned lane = 0;
  for (const Input& input : inputs_) {
    for (unsigned i = 0; i < bytes_; ++i, ++lane) {
      out.data[lane] = input.beats.front().bytes.data[i];
      out.keep[lane] = input.beats.front().bytes.keep[i];
    }
  }
  const Beat& leader = inputs_[leader_].beats.front();
  const auto to = user_wires(m_axis.link());
  for (std::size_t i = 0; i < std::min(leader.users.size(), to.size()); ++i)
    *to[i] = leader.users[i];
  m_axis.offer(out, leader.last);
  for (Input& input : inputs_) input.beats.pop_front();
}

vp::IpEstimate AxisCombiner::own_estimate() const {
  const auto inputs = static_cast<std::uint32_t>(inputs_.size());
  vp::IpEstimate e =
      axi_estimate("axis_combiner", 5 + 5 * inputs, 2 * inputs * vp::bits_per_byte * bytes_, 0);
  e.source = "assumed: registers of two beats of each input";
  e.active_clocks = [this] { return m_axis.bound() ? m_axis.link().beats.get() : 0; };
  return e;
}

}  // namespace xilinx
