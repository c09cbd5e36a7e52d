#include <chip/fault/prospects.h>

#include <utility>

#include <vp/mm_link.h>
#include <vp/signal.h>
#include <xilinx/bram/bram.h>

namespace platform {

namespace {

/// A fault without its time.
std::string words_of(const Fault& fault) {
  const std::size_t from = fault.text.find(", at: ");
  if (from == std::string::npos) return fault.text;
  const std::size_t to = fault.text.find_first_of(",}", from + 1);
  return fault.text.substr(0, from) + fault.text.substr(to);
}

/// Meets only what comes next at its place.
bool is_single(const Fault& fault) {
  return fault.nth == 1 && fault.count == 1 && fault.of == Fault::Of::accesses &&
         !fault.has_address;
}

/// The use of the place of that path; null: there is no such place.
template <class Place, class Use>
Use* use_of(std::map<std::string, std::unique_ptr<Use>>& uses, const std::string& path) {
  std::unique_ptr<Use>& use = uses[path];
  auto* const place = use ? nullptr : dynamic_cast<Place*>(sc_core::sc_find_object(path.c_str()));
  if (place) use = std::make_unique<Use>(*place);
  return use.get();
}

}  // namespace

/// Counts the accesses on a link, by their length.
class Prospects::LinkUse : public vp::MmObserver {
 public:
  explicit LinkUse(vp::MmLink& link) : link_(link) { link_.add_observer(*this); }
  ~LinkUse() override { link_.remove_observer(*this); }

  void before(vp::MmLink&, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override {
    ++by_length_[payload.get_data_length()];
  }
  /// Of at least so many bytes.
  std::uint64_t accesses(unsigned bytes) const {
    std::uint64_t count = 0;
    for (auto length = by_length_.lower_bound(bytes); length != by_length_.end(); ++length)
      count += length->second;
    return count;
  }

 private:
  vp::MmLink& link_;
  std::map<unsigned, std::uint64_t> by_length_;
};

/// Counts what the writer of a signal does, and lets it.
class Prospects::SignalUse : public vp::SignalForce {
 public:
  explicit SignalUse(vp::SignalBase& signal) : signal_(signal), driven_(signal.bits()) {
    signal_.force(this);
  }
  ~SignalUse() override { signal_.force(nullptr); }

  std::uint64_t seen(std::uint64_t driven) override {
    if (driven != driven_) ++changes_;
    if (driven != 0 && driven_ == 0) ++rises_;
    return driven_ = driven;
  }
  std::uint64_t level() const { return signal_.bits(); }
  std::uint64_t changes() const { return changes_; }
  std::uint64_t rises() const { return rises_; }

 private:
  vp::SignalBase& signal_;
  std::uint64_t driven_;
  std::uint64_t changes_ = 0, rises_ = 0;
};

/// Sees whether bytes of a memory are written before the memory is read.
class Prospects::MemoryUse : public xilinx::Bram::Reader {
 public:
  explicit MemoryUse(xilinx::Bram& memory) : memory_(memory), reader_(memory.reader()) {
    memory_.set_reader(this);
  }
  ~MemoryUse() override { memory_.set_reader(reader_); }

  /// `found` changes nothing if that byte is written first from now on.
  void wait_for(std::uint32_t byte, Prospect& found) {
    memory_.settle();
    if (!reads()) waiting_.emplace(byte, Waiting{memory_.reads_b.get(), &found});
  }
  /// Nothing comes any more.
  void finish() { resolve(waiting_.begin(), waiting_.end()); }

  bool reads() override { return reader_ && reader_->reads(); }
  bool reads_now(std::uint32_t first, std::uint32_t count) override {
    return reader_ && reader_->reads_now(first, count);
  }
  void before_write(std::uint32_t first, std::uint32_t count) override {
    resolve(waiting_.lower_bound(first), waiting_.lower_bound(first + count));
    if (reader_) reader_->before_write(first, count);
  }
  void after_write(std::uint32_t first, std::uint32_t count) override {
    if (reader_) reader_->after_write(first, count);
  }

 private:
  struct Waiting {
    std::uint64_t reads;  ///< of the memory, when its fault would happen
    Prospect* found;
  };
  using Place = std::multimap<std::uint32_t, Waiting>::iterator;

  void resolve(Place from, Place to) {
    for (Place one = from; one != to; one = waiting_.erase(one)) {
      if (reads() || memory_.reads_b.get() != one->second.reads) continue;
      one->second.found->changes_nothing = true;
      one->second.found->times = 1;
    }
  }

  xilinx::Bram& memory_;
  xilinx::Bram::Reader* const reader_;
  std::multimap<std::uint32_t, Waiting> waiting_;
};

Prospects::Prospects(Injector& injector) : injector_(injector) {}
Prospects::~Prospects() = default;

void Prospects::look_at(const Fault& fault) {
  using What = Fault::What;
  Prospect& found = found_.emplace_back(Prospect{false, 0, fault.text});
  switch (fault.what) {
    case What::slverr:
    case What::decerr:
    case What::corrupt:
      return look_at_accesses(fault, found);
    case What::lost:
    case What::late:
      return look_at_edges(fault, found);
    case What::stuck:
    case What::spurious:
      return look_at_level(fault, found);
    case What::flip:
      return look_at_byte(fault, found);
    case What::dropped:
    case What::repeated:
    case What::tlast:
    case What::clock:
    case What::input:
    case What::torn:
      return;
  }
}

std::vector<Prospects::Prospect> Prospects::found() {
  for (const std::function<void()>& look : at_end_) look();
  for (const auto& [path, memory] : memories_) {
    if (memory) memory->finish();
  }
  return {found_.begin(), found_.end()};
}

void Prospects::look_at_count(const Fault& fault, Prospect& found,
                              std::function<std::uint64_t()> count) {
  injector_.plan(fault.at_ps, [this, &found, words = words_of(fault), count = std::move(count)] {
    const std::uint64_t before = count();
    found.meets = words + " " + std::to_string(before);
    at_end_.emplace_back([&found, before, count] { found.changes_nothing = count() == before; });
  });
}

void Prospects::look_at_accesses(const Fault& fault, Prospect& found) {
  constexpr unsigned bits = 8;
  const LinkUse* const use = use_of<vp::MmLink>(links_, fault.where);
  if (!use || !is_single(fault)) return;
  const unsigned bytes = fault.what == Fault::What::corrupt ? fault.bit / bits + 1 : 0;
  look_at_count(fault, found, [use, bytes] { return use->accesses(bytes); });
}

void Prospects::look_at_edges(const Fault& fault, Prospect& found) {
  const SignalUse* const use = use_of<vp::SignalBase>(signals_, fault.where);
  if (use && is_single(fault)) look_at_count(fault, found, [use] { return use->rises(); });
}

void Prospects::look_at_level(const Fault& fault, Prospect& found) {
  const SignalUse* const use = use_of<vp::SignalBase>(signals_, fault.where);
  if (!use || fault.for_ps == Fault::for_ever) return;
  const std::uint64_t value = fault.what == Fault::What::spurious ? 1 : fault.value;
  injector_.plan(fault.at_ps, [this, &found, use, value, end_ps = fault.at_ps + fault.for_ps] {
    if (use->level() != value) return;
    injector_.plan(end_ps, [&found, use, before = use->changes()] {
      if (use->changes() != before) return;
      found.changes_nothing = true;
      found.times = 1;
    });
  });
}

void Prospects::look_at_byte(const Fault& fault, Prospect& found) {
  const auto byte = static_cast<std::uint32_t>(fault.address);
  // Whatever reads the memory is known once the simulation runs.
  if (fault.where.empty()) return;
  injector_.plan(fault.at_ps, [this, &found, path = fault.where, byte] {
    MemoryUse* const use = use_of<xilinx::Bram>(memories_, path);
    if (use) use->wait_for(byte, found);
  });
}

}  // namespace platform
