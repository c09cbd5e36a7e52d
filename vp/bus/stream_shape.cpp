#include <vp/stream_shape.h>

#include <vp/error.h>

#include <algorithm>

namespace vp {

namespace {

constexpr unsigned usual_bytes = 4;
constexpr unsigned data_bits = 32, keep_bits = 8;  ///< which AxiStream has wires for

std::string text(unsigned bits) {
  return std::to_string(bits) + (bits == 1 ? " bit" : " bits");
}

[[noreturn]] void refuse(const StreamShape& master, const StreamShape& slave, StreamField field,
                         unsigned sent, unsigned taken, const char* advice) {
  throw InputError(master.end + " sends " + text(sent) + " of " + to_string(field) + ", and " +
                   slave.end + " takes " + text(taken) + ": " + advice);
}

/// Bits `low` to `end` - 1, in pieces that lie in a word.
void add(std::vector<StreamPart>& parts, StreamField field, unsigned low, unsigned end) {
  constexpr unsigned word = 32;
  while (low < end) {
    const unsigned piece = low % word == 0 ? word : low;
    parts.push_back({field, low, std::min(piece, end - low)});
    low += parts.back().bits;
  }
}

}  // namespace

const char* to_string(StreamField field) {
  constexpr const char* names[] = {"TDATA", "TKEEP", "TSTRB", "TUSER", "TID", "TDEST"};
  return names[static_cast<unsigned>(field)];
}

unsigned StreamShape::bits(StreamField field) const {
  switch (field) {
    case StreamField::data:
      return bits_per_byte * bytes;
    case StreamField::keep:
      return bytes;
    case StreamField::strobe:
      return strobe;
    case StreamField::user:
      return user;
    case StreamField::id:
      return id;
    case StreamField::dest:
      break;
  }
  return dest;
}

std::string StreamPart::name() const {
  constexpr const char* names[] = {"tdata", "tkeep", "tstrb", "tuser", "tid", "tdest"};
  std::string field_name = names[static_cast<unsigned>(field)];
  if (low == 0) return field_name;
  return field_name + "_" + std::to_string(low + bits - 1) + "_" + std::to_string(low);
}

unsigned bytes_between(const StreamShape& master, const StreamShape& slave) {
  if (master.bytes != 0 && slave.bytes != 0 && master.bytes != slave.bytes) {
    refuse(master, slave, StreamField::data, bits_per_byte * master.bytes,
           bits_per_byte * slave.bytes, "put a width converter between");
  }
  for (const StreamField field : {StreamField::user, StreamField::id, StreamField::dest}) {
    const bool loses = slave.bits(field) != 0 && slave.bits(field) < master.bits(field);
    if (loses && !slave.ignores_upper_bits) {
      refuse(master, slave, field, master.bits(field), slave.bits(field),
             "the upper ones would be lost; make both alike");
    }
  }
  return master.bytes != 0 ? master.bytes : slave.bytes != 0 ? slave.bytes : usual_bytes;
}

std::vector<StreamPart> parts_between(const StreamShape& master, const StreamShape& slave) {
  const unsigned bytes = bytes_between(master, slave);
  std::vector<StreamPart> parts;
  add(parts, StreamField::data, data_bits, bits_per_byte * bytes);
  add(parts, StreamField::keep, keep_bits, bytes);
  for (const StreamField field :
       {StreamField::strobe, StreamField::user, StreamField::id, StreamField::dest}) {
    add(parts, field, 0, master.bits(field));
  }
  return parts;
}

}  // namespace vp
