#include <cstdint>
#include <initializer_list>

#include <axi/rtl_part.h>
#include <chip/fault/injector.h>
#include <chip/fault/places.h>
#include <vp/axi_stream.h>

namespace platform {

namespace {

/// Beats that pass on a stream, or are offered there, one an edge at most.
class BeatCount {
 public:
  /// The number of the beat of this instant, from 1.
  std::uint64_t number(std::uint64_t now_ps) {
    if (count_ == 0 || now_ps != last_ps_) ++count_;
    last_ps_ = now_ps;
    return count_;
  }

 private:
  std::uint64_t count_ = 0;
  std::uint64_t last_ps_ = 0;
};

class BeatFault : public FaultyPlace, public vp::StreamFault {
 public:
  BeatFault(Injector& injector, Injection& injection, vp::AxiStream& stream)
      : injector_(injector), injection_(injection), stream_(stream) {
    stream_.pass_singly(this);
  }
  ~BeatFault() override { stream_.pass_singly(nullptr); }

  void offered(std::uint32_t& data, bool& last) override {
    const bool corrupts = fault().what == Fault::What::corrupt;
    if (!corrupts && fault().what != Fault::What::tlast) return;
    if (!meets(offers_)) return;
    if (corrupts) {
      data ^= std::uint32_t{1} << fault().bit;
    } else {
      last = !last;
    }
    injection_.happened(now_ps());
  }

  bool drops() override {
    if (fault().what != Fault::What::dropped || !meets(passes_)) return false;
    injection_.happened(now_ps());
    return true;
  }

  // Asked more than once an edge. A beat that was repeated is the same one: it passes then.
  bool repeats() override {
    if (fault().what != Fault::What::repeated) return false;
    const std::uint64_t now = now_ps();
    if (now == asked_ps_) return repeats_;
    asked_ps_ = now;
    if (repeats_) return repeats_ = false;
    repeats_ = meets(passes_);
    if (repeats_) injection_.happened(now);
    return repeats_;
  }

 private:
  const Fault& fault() const { return injection_.fault; }
  std::uint64_t now_ps() const { return injector_.zynq().scheduler.now_ps(); }
  bool meets(BeatCount& count) {
    return now_ps() >= fault().at_ps && fault().meets(count.number(now_ps()));
  }

  Injector& injector_;
  Injection& injection_;
  vp::AxiStream& stream_;
  BeatCount offers_, passes_;
  std::uint64_t asked_ps_ = Fault::for_ever;
  bool repeats_ = false;
};

/// The user's RTL at an end of `stream`; null without.
const sc_core::sc_object* rtl_end(const vp::AxiStream& stream) {
  for (const vp::SignalBase* wire :
       std::initializer_list<const vp::SignalBase*>{&stream.tvalid, &stream.tready}) {
    for (const sc_core::sc_object* end = wire->writer(); end; end = end->get_parent_object()) {
      if (dynamic_cast<const axi::RtlPart*>(end)) return end;
    }
  }
  return nullptr;
}

}  // namespace

bool counts_beats(const vp::AxiStream& stream) {
  return rtl_end(stream) == nullptr;
}

bool is_stream(const std::string& path) {
  return dynamic_cast<vp::AxiStream*>(sc_core::sc_find_object(path.c_str())) != nullptr;
}

void let_streams_fail() {
  for (vp::AxiStream* stream : vp::all_objects<vp::AxiStream>()) stream->pass_singly(nullptr);
}

std::unique_ptr<FaultyPlace> place_stream_fault(Injector& injector, Injection& injection) {
  vp::AxiStream& stream = place_named<vp::AxiStream>(injection.fault.where, "a stream");
  if (injection.fault.bit >= stream.tdata.width())
    throw vp::InputError(std::string(stream.name()) + ".tdata has " +
                         std::to_string(stream.tdata.width()) + " bits: 'bit' counts from 0");
  if (const sc_core::sc_object* rtl = rtl_end(stream))
    throw vp::InputError(std::string(stream.name()) + " has RTL at an end (" + rtl->name() +
                         "), whose beats are not counted: let one of its wires be stuck");
  if (stream.has_fault())
    throw vp::InputError(std::string(stream.name()) + " has a fault already: one is possible");
  return std::make_unique<BeatFault>(injector, injection, stream);
}

}  // namespace platform
