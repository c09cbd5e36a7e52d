#include <vp/axi_stream.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include <vp/ip.h>
#include <vp/rule_reports.h>
#include <vp/stream_checker.h>

namespace vp {

namespace {

constexpr unsigned data_bytes = 4, keep_lanes = 8;  // of tdata and tkeep

std::uint32_t word_at(const StreamBytes& beat, unsigned byte) {
  std::uint32_t word = 0;
  std::memcpy(&word, &beat.data[byte], sizeof word);
  return word;
}

std::uint32_t lanes_at(const StreamBytes& beat, unsigned first, unsigned lanes) {
  std::uint32_t word = 0;
  for (unsigned i = 0; i < lanes; ++i) word |= std::uint32_t{beat.keep[first + i]} << i;
  return word;
}

[[noreturn]] void second_end(const AxiStream& link, const char* end) {
  throw std::logic_error(std::string(link.name()) + ": a second " + end + " is bound to this link");
}

std::string end_name(const char* port, const Clocked& owner) {
  return std::string(owner.name()) + "." + port;
}

}  // namespace

AxiStream::AxiStream(sc_core::sc_module_name name) : sc_module(name) {}

AxiStream::~AxiStream() = default;

void AxiStream::check_beat(bool last) {
  if (checker_) checker_->pass(last);
}

// Whole beats, until a master says other.
void AxiStream::join() {
  if (!master_ || !slave_end_) return;
  const StreamShape &from = master_->shape(), &to = slave_end_->shape();
  bytes_ = bytes_between(from, to);
  tkeep.set_width(std::clamp(bytes_, data_bytes, keep_lanes));
  whole_keep_ = static_cast<std::uint8_t>((1u << std::min(bytes_, keep_lanes)) - 1);
  const HierarchyScope inside(*this);
  for (const StreamPart& part : parts_between(from, to)) {
    const bool whole = part.field == StreamField::keep || part.field == StreamField::strobe;
    const std::uint32_t initial = whole ? ~0u >> (32 - part.bits) : 0;
    more_lanes_ = more_lanes_ || whole;
    parts_.emplace_back(part, initial, master_->owner_, slave_end_->owner_);
  }
}

StreamBytes AxiStream::beat() const {
  StreamBytes beat;
  const auto set_data = [&beat](unsigned byte, std::uint32_t word) {
    std::memcpy(&beat.data[byte], &word, sizeof word);
  };
  const auto set_keep = [&beat](unsigned first, unsigned lanes, std::uint32_t word) {
    for (unsigned i = 0; i < lanes; ++i) beat.keep[first + i] = (word >> i & 1) != 0;
  };
  set_data(0, tdata.get());
  set_keep(0, std::min(bytes_, keep_lanes), tkeep.get());
  for (const auto& [part, wire, reader] : parts_) {
    if (part.field == StreamField::data) set_data(part.low / bits_per_byte, wire.get());
    if (part.field == StreamField::keep) set_keep(part.low, part.bits, wire.get());
  }
  return beat;
}

void AxiStream::show(const StreamBytes& beat) {
  tdata = word_at(beat, 0);
  tkeep = static_cast<std::uint8_t>(lanes_at(beat, 0, std::min(bytes_, keep_lanes)));
  for (auto& [part, wire, reader] : parts_) {
    if (part.field == StreamField::data) wire = word_at(beat, part.low / bits_per_byte);
    if (part.field == StreamField::keep) wire = lanes_at(beat, part.low, part.bits);
  }
}

void AxiStream::excuse() {
  if (checker_) checker_->excuse();
}

void AxiStream::end_of_simulation() {
  if (checker_) checker_->finish();
}

void AxiStream::pass_singly(StreamFault* fault) {
  const bool elaborates = sc_core::sc_get_status() < sc_core::SC_END_OF_ELABORATION;
  if (!elaborates && rests())
    throw std::logic_error(std::string(name()) + ": its beats do not pass one by one");
  slave_takes_source_ = false;
  sink_ = nullptr;
  fault_ = fault;
}

void AxiStream::start_of_simulation() {
  if (!master_ || !slave_ || !links_are_watched()) return;
  std::vector<StreamChecker::Reset> resets;
  for (const AxiStreamMaster::Reset& reset : master_->resets_) {
    if (SignalBase* signal = reset.signal()) resets.push_back({signal, reset.active_low});
  }
  checker_ = std::make_unique<StreamChecker>(*this, slave_->clock(), resets);
}

AxiStreamMaster::AxiStreamMaster(const char* name, Clocked& owner)
    : tdata(&owner),
      tkeep(&owner),
      tvalid(&owner),
      tlast(&owner),
      tready((std::string(name) + "_tready").c_str(), &owner),
      owner_(owner),
      shape_{end_name(name, owner)} {}

void AxiStreamMaster::bind(AxiStream& link) {
  if (link.master_) second_end(link, "master");
  link.master_ = this;
  link.join();
  link_ = &link;
  tdata(link.tdata);
  tkeep(link.tkeep);
  tvalid(link.tvalid);
  tlast(link.tlast);
  tready(link.tready);
}

AxiStreamSlave::AxiStreamSlave(const char* name, Clocked& owner)
    : tdata((std::string(name) + "_tdata").c_str(), &owner),
      tkeep((std::string(name) + "_tkeep").c_str(), &owner),
      tvalid((std::string(name) + "_tvalid").c_str(), &owner),
      tlast((std::string(name) + "_tlast").c_str(), &owner),
      tready(&owner),
      owner_(owner),
      shape_{end_name(name, owner)} {}

void AxiStreamSlave::bind(AxiStream& link) {
  if (link.slave_) second_end(link, "slave");
  link.slave_ = &owner_;
  link.slave_end_ = this;
  link.join();
  link.slave_takes_source_ = takes_source_;
  link.sink_ = sink_;
  link_ = &link;
  tdata(link.tdata);
  tkeep(link.tkeep);
  tvalid(link.tvalid);
  tlast(link.tlast);
  tready(link.tready);
}

// While the master waits it holds its beat (tvalid must not fall), and the slave's tready changes
// on its own edges only: so the edges the slave slept through since its last look were stalls too.
void AxiStreamSlave::count_stall(bool valid) {
  const std::uint64_t cycle = owner_.clock().cycle();
  if (waiting_) {
    link_->stalls.add(cycle - last_stall_cycle_ - (valid ? 0 : 1));
  } else {
    ++link_->stalls;
  }
  waiting_ = valid;
  last_stall_cycle_ = cycle;
}

}  // namespace vp
