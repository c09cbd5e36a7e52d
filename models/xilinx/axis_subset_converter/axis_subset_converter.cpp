#include <xilinx/axis_subset_converter/axis_subset_converter.h>

#include <algorithm>

#include <vp/error.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

using SubsetFrom = RemapBit::From;
constexpr std::uint32_t subset_reset_pin = 1;
constexpr std::size_t slice_beats = 2;
constexpr unsigned most_side_bits = 64;

}  // namespace

AxisSubsetConverter::AxisSubsetConverter(sc_core::sc_module_name name, vp::Clock& aclk,
                                         const AxisSubsetConverterBuild& build)
    : Clocked(name, aclk),
      Ip(&aclk),
      default_last("default_last", build.default_last, vp::Unit::none, {0, 1u << 20},
                   vp::Source::published, "TLAST with each so many beats; 0: none of its own"),
      build_(build) {
  for (const AxisSubsetEnd* end : {&build.in, &build.out}) {
    if (end->bytes < 1 || end->bytes > vp::most_stream_bytes ||
        std::max({end->user, end->id, end->dest}) > most_side_bits)
      throw vp::InputError(std::string(this->name()) +
                           ": TDATA of 1 to 128 bytes is modelled, and TUSER, TID and TDEST of up "
                           "to 64 bits");
  }
  data_ = bits_of(build.data, SubsetFrom::data, vp::bits_per_byte * build.out.bytes, "TDATA");
  user_ = bits_of(build.user, SubsetFrom::user, build.out.user, "TUSER");
  id_ = bits_of(build.id, SubsetFrom::id, build.out.id, "TID");
  dest_ = bits_of(build.dest, SubsetFrom::dest, build.out.dest, "TDEST");
  last_ = bits_of(build.last, SubsetFrom::last, 1, "TLAST");
  if (!build.keep.empty()) keep_ = bits_of(build.keep, SubsetFrom::keep, build.out.bytes, "TKEEP");
  s_axis.set_shape({std::string(this->name()) + ".s_axis", build.in.bytes, 0, build.in.user,
                    build.in.id, build.in.dest});
  m_axis.set_shape({std::string(this->name()) + ".m_axis", build.out.bytes, 0, build.out.user,
                    build.out.id, build.out.dest});
  wake_on(s_axis.tvalid);
  wake_on(m_axis.tready);
}

unsigned AxisSubsetConverter::width_in(SubsetFrom from) const {
  switch (from) {
    case SubsetFrom::data:
      return vp::bits_per_byte * build_.in.bytes;
    case SubsetFrom::keep:
    case SubsetFrom::strobe:
      return build_.in.bytes;
    case SubsetFrom::user:
      return build_.in.user;
    case SubsetFrom::id:
      return build_.in.id;
    case SubsetFrom::dest:
      return build_.in.dest;
    default:
      return 1;
  }
}

AxisSubsetConverter::Bits AxisSubsetConverter::bits_of(const std::string& expression,
                                                       SubsetFrom same, unsigned width,
                                                       const char* signal) const {
  if (expression.empty()) {
    Bits bits(width);
    for (unsigned bit = 0; bit < std::min(width, width_in(same)); ++bit) bits[bit] = {same, bit};
    return bits;
  }
  const std::string of = std::string(this->name()) + ": " + signal + "_REMAP";
  Bits bits = parse_remap(expression, of);
  for (const RemapBit& bit : bits) {
    if (bit.bit >= std::max(1u, width_in(bit.from)))
      throw vp::InputError(of + " takes bit " + std::to_string(bit.bit) + " of a signal that has " +
                           std::to_string(width_in(bit.from)));
    // A signal that does not come reads 0.
  }
  if (width != 0 && bits.size() != width)
    throw vp::InputError(of + " has " + std::to_string(bits.size()) + " bits, and its signal " +
                         std::to_string(width));
  return bits;
}

void AxisSubsetConverter::end_of_elaboration() {
  Clocked::end_of_elaboration();
  if (aresetn.bound()) aresetn.signal()->attach(*this, subset_reset_pin);
}

void AxisSubsetConverter::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id != subset_reset_pin) return Clocked::on_change(signal, id);
  wake();
}

void AxisSubsetConverter::edge() {
  if (m_axis.accepted()) beats_.pop_front();
  if (s_axis.sample()) beats_.push_back(convert());
  if (aresetn.bound() && !aresetn) {
    beats_.clear();
    since_last_ = 0;
    s_axis.tready = false;
    m_axis.excuse();
    m_axis.withdraw();
    return sleep();
  }
  if (m_axis.free()) {
    if (beats_.empty()) {
      m_axis.withdraw();
    } else {
      const Beat& beat = beats_.front();
      m_axis.offer(beat.bytes, beat.last);
      show(vp::StreamField::user, beat.user);
      show(vp::StreamField::id, beat.id);
      show(vp::StreamField::dest, beat.dest);
    }
  }
  s_axis.tready = beats_.size() < slice_beats;
  if (beats_.empty() && !s_axis.tvalid.read()) return sleep();
  wake();
}

AxisSubsetConverter::Beat AxisSubsetConverter::convert() {
  Beat in;
  in.bytes = s_axis.link().beat();
  in.last = s_axis.tlast.read();
  in.user = side(vp::StreamField::user);
  in.id = side(vp::StreamField::id);
  in.dest = side(vp::StreamField::dest);
  Beat out;
  for (std::size_t bit = 0; bit < data_.size(); ++bit)
    if (value(data_[bit], in))
      out.bytes.data[bit / vp::bits_per_byte] |=
          static_cast<unsigned char>(1u << bit % vp::bits_per_byte);
  for (unsigned lane = 0; lane < build_.out.bytes; ++lane)
    out.bytes.keep[lane] = keep_.empty() || value(keep_[lane], in);
  out.user = word(user_, in);
  out.id = word(id_, in);
  out.dest = word(dest_, in);
  out.last = word(last_, in) != 0;
  if (default_last != 0) {
    out.last = ++since_last_ >= default_last;
    if (out.last) since_last_ = 0;
  }
  return out;
}

std::uint64_t AxisSubsetConverter::side(vp::StreamField field) {
  std::uint64_t all = 0;
  for (auto& part : s_axis.link().parts())
    if (part.part.field == field && part.part.low < most_side_bits)
      all |= std::uint64_t{part.wire.get()} << part.part.low;
  return all;
}

void AxisSubsetConverter::show(vp::StreamField field, std::uint64_t value) {
  for (auto& part : m_axis.link().parts()) {
    if (part.part.field != field || part.part.low >= most_side_bits) continue;
    const std::uint64_t mask = (std::uint64_t{1} << part.part.bits) - 1;
    part.wire = static_cast<std::uint32_t>(value >> part.part.low & mask);
  }
}

bool AxisSubsetConverter::value(const RemapBit& bit, const Beat& in) const {
  switch (bit.from) {
    case SubsetFrom::zero:
      return false;
    case SubsetFrom::one:
      return true;
    case SubsetFrom::data:
      return (in.bytes.data[bit.bit / vp::bits_per_byte] >> bit.bit % vp::bits_per_byte & 1) != 0;
    case SubsetFrom::keep:
    case SubsetFrom::strobe:
      return in.bytes.keep[bit.bit];
    case SubsetFrom::last:
      return in.last;
    case SubsetFrom::user:
      return (in.user >> bit.bit & 1) != 0;
    case SubsetFrom::id:
      return (in.id >> bit.bit & 1) != 0;
    case SubsetFrom::dest:
      break;
  }
  return (in.dest >> bit.bit & 1) != 0;
}

std::uint64_t AxisSubsetConverter::word(const Bits& bits, const Beat& in) const {
  std::uint64_t all = 0;
  for (std::size_t bit = 0; bit < bits.size() && bit < most_side_bits; ++bit)
    if (value(bits[bit], in)) all |= std::uint64_t{1} << bit;
  return all;
}

vp::IpEstimate AxisSubsetConverter::own_estimate() const {
  const std::uint32_t bits = vp::bits_per_byte * build_.out.bytes + build_.out.user + 1;
  vp::IpEstimate e =
      axi_estimate("axis_subset_converter", 10 + (default_last != 0 ? 20 : 0), 2 * bits, 0);
  e.source = "assumed: wires, and registers of two beats";
  e.active_clocks = [this] { return s_axis.bound() ? s_axis.link().beats.get() : 0; };
  return e;
}

}  // namespace xilinx
