#include <chip/watch/remote_control.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <utility>

#include <chip/system/hardware_map.h>
#include <chip/watch/board_control.h>
#include <chip/watch/bus_control.h>
#include <chip/watch/bus_log.h>
#include <chip/watch/command_fields.h>
#include <poll.h>
#include <sys/socket.h>
#include <vp/axi_stream.h>
#include <vp/expression.h>
#include <vp/kernel.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform {

namespace {

using Json = nlohmann::json;

constexpr std::size_t longest_command = 1 << 20;

/// Of "5 ms".
std::uint64_t time_of(const Json& command, const char* key) {
  const std::string text = text_of(command, key);
  std::optional<vp::Decimal::Whole> ps;
  try {
    ps = vp::parse_quantity(text, vp::Unit::time).whole();
  } catch (const vp::InputError& error) {
    throw vp::InputError(std::string(key) + " '" + text + "' " + error.what());
  }
  constexpr std::uint64_t most = 1'000'000'000'000'000;
  if (!ps || *ps < 0 || *ps > most)
    throw vp::InputError(std::string(key) + " '" + text + "' is not between 0 and 1000 s, in ps");
  return static_cast<std::uint64_t>(*ps);
}

template <class T>
void collect(const std::vector<sc_core::sc_object*>& objects, std::vector<std::string>& names) {
  for (const sc_core::sc_object* object : objects) {
    if (dynamic_cast<const T*>(object)) names.emplace_back(object->name());
    collect<T>(object->get_child_objects(), names);
  }
}

template <class T>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  collect<T>(sc_core::sc_get_top_level_objects(), names);
  return names;
}

vp::SignalBase& signal_named(const std::string& name) {
  if (auto* signal = dynamic_cast<vp::SignalBase*>(sc_core::sc_find_object(name.c_str())))
    return *signal;
  const std::string near = vp::nearest_match(name, names_of<vp::SignalBase>());
  throw vp::InputError("no signal '" + name + "'" +
                       (near.empty() ? ": a trace with --trace-level everything shows their names"
                                     : ": did you mean '" + near + "'?"));
}

/// An end of a stream that the design leaves to the test; `what` is it in words.
template <class T>
T& stream_end_named(const std::string& name, const std::string& what) {
  if (auto* end = dynamic_cast<T*>(sc_core::sc_find_object(name.c_str()))) return *end;
  const std::vector<std::string> names = names_of<T>();
  std::string choice = names.empty() ? ": this design has none" : ": choose ";
  for (const std::string& one : names) choice += (&one == &names.front() ? "" : ", ") + one;
  throw vp::InputError("no " + what + " '" + vp::excerpt(name) + "'" + choice);
}

long double number_in(const vp::SignalBase& signal) {
  if (!signal.is_real()) return static_cast<long double>(signal.bits());
  const std::uint64_t bits = signal.bits();
  double real = 0;
  std::memcpy(&real, &bits, sizeof real);
  return real;
}

template <class T>
bool write_as(vp::SignalBase& signal, std::uint64_t value) {
  auto* typed = dynamic_cast<vp::Signal<T>*>(&signal);
  if (typed) typed->write(static_cast<T>(value));
  return typed != nullptr;
}

}  // namespace

/// What a test waits for: an expression over signals, and over registers that are looked at from
/// time to time.
struct RemoteControl::Condition : vp::ExpressionValues {
  explicit Condition(vp::SignalListener& listener) : listener_(listener) {}
  ~Condition() override {
    if (!attached_) return;
    for (Source& source : sources) {
      if (source.signal) source.signal->detach(listener_);
    }
  }
  void attach() {
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
      if (sources[i].signal) sources[i].signal->attach(listener_, i);
    }
    attached_ = true;
  }

  struct Source {
    vp::SignalBase* signal;  ///< null: a register
    std::uint32_t address;
    long double now, before;
  };
  vp::Expression expression;
  std::vector<Source> sources;
  bool polled = false;

  vp::ExpressionValue now(std::uint32_t name) const override { return sources[name].now; }
  vp::ExpressionValue before(std::uint32_t name) const override { return sources[name].before; }
  /// A new instant, in which one of them changes.
  bool step(std::size_t place, long double value) {
    for (Source& source : sources) source.before = source.now;
    sources[place].now = value;
    return expression.holds(*this);
  }

 private:
  vp::SignalListener& listener_;
  bool attached_ = false;
};

RemoteControl::RemoteControl(sc_core::sc_module_name name, Zynq& zynq, int socket)
    : sc_module(name), zynq_(zynq), socket_(socket) {
  sc_core::sc_spawn_options options;
  options.set_stack_size(1 << 18);  // expressions and JSON
  sc_core::sc_spawn([this] { lead(); }, "lead", &options);
  vp::HostTicks::add(*this);
}

RemoteControl::~RemoteControl() {
  vp::HostTicks::remove(*this);
}

// In a signal handler. A parent-death signal would also come when the test's thread ends that
// started the run. What waits for the next command hears it by itself; the rest is interrupted as
// by Ctrl-C.
void RemoteControl::on_host_tick(std::uint64_t spent_ns, void*) {
  constexpr std::uint64_t patience_ns = 300'000'000;
  pollfd test{socket_, POLLRDHUP, 0};
  if (::poll(&test, 1, 0) <= 0) return;
  const bool is_due = alone_ns_ < patience_ns;
  alone_ns_ += spent_ns;
  if (is_due && alone_ns_ >= patience_ns) vp::raise_again(SIGTERM);
}

void RemoteControl::printed(const std::string& line) {
  console_.push_back(line);
  if (!text_.empty() && line.find(text_) != std::string::npos) met();
}

void RemoteControl::met() {
  met_ = true;
  text_.clear();
  zynq_.scheduler.notify(woken_);
}

void RemoteControl::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (condition_ && !met_ && condition_->step(id, number_in(signal))) met();
}

void RemoteControl::lead() {
  while (!finished_ && !left_) {
    const std::optional<Json> command = next_command();
    busy_ = true;
    left_ = !command;
    if (left_ && !ended_) sc_core::sc_stop();
    if (left_) return;
    Json reply = obey(*command);
    if (!finished_) answer(std::move(reply));
  }
}

// The thread may stand in a command that the end of the run cut short.
void RemoteControl::finish() {
  ended_ = true;
  condition_.reset();
  if (busy_ && !finished_ && !left_) answer({{"met", met_}});
  lead();
  if (left_)
    throw vp::InputError("the test left the run at " + vp::format_time(zynq_.scheduler.now_ps()) +
                         " without 'finish'");
}

// Nothing: the test is gone, or was interrupted.
std::optional<Json> RemoteControl::next_command() {
  for (;;) {
    const std::size_t end = unread_.find('\n');
    if (end != std::string::npos) {
      const std::string line = unread_.substr(0, end);
      unread_.erase(0, end + 1);
      return Json::parse(line, nullptr, false);
    }
    char bytes[4096];
    const ssize_t count = ::recv(socket_, bytes, sizeof bytes, 0);
    if (count <= 0 || unread_.size() > longest_command) return std::nullopt;
    unread_.append(bytes, static_cast<std::size_t>(count));
  }
}

void RemoteControl::answer(Json reply) {
  busy_ = false;
  reply["time_ps"] = zynq_.scheduler.now_ps();
  reply["ended"] = ended_;
  reply["console"] = std::exchange(console_, {});
  const std::string line = reply.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  for (std::size_t sent = 0; sent < line.size();) {
    const ssize_t count = ::send(socket_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;  // the next command will not come
    sent += static_cast<std::size_t>(count);
  }
}

Json RemoteControl::obey(const Json& command) {
  try {
    if (!command.is_object()) throw vp::InputError("a command is a line with a JSON object");
    const std::string what = text_of(command, "do");
    finished_ = what == "finish";
    if (finished_) return Json::object();
    if (what == "read") return read(command);
    if (what == "received") return received(command);
    if (what == "signal")
      return Json{
          {"value", static_cast<double>(number_in(signal_named(text_of(command, "name"))))}};
    if (ended_) return Json{{"met", false}};
    return obey_in_time(what, command);
  } catch (const vp::InputError& error) {
    return Json{{"error", error.what()}};
  }
}

Json RemoteControl::obey_in_time(const std::string& what, const Json& command) {
  if (what == "run") {
    pass(time_of(command, "for"));
    return Json::object();
  }
  if (what == "wait") return wait_for(command);
  if (what == "wait_text") return wait_for_text(command);
  if (what == "write") return write(command);
  if (what == "drive") return drive(command);
  if (what == "interrupt") return interrupt(command);
  if (what == "send") return send(command);
  if (is_for_the_bus(what)) return obey_for_the_bus(zynq_, what, command);
  if (is_for_the_board(what)) {
    zynq_.settle();
    return obey_for_the_board(zynq_, what, command);
  }
  throw vp::InputError(
      "no command '" + vp::excerpt(what) +
      "': there are run, wait, wait_text, read, signal, write, drive, receive, "
      "interrupt, send, received, pin, attach, contents, analogue, access, memory, "
      "devices and finish");
}

/// Lets simulated time pass, less if what the test waits for comes.
void RemoteControl::pass(std::uint64_t ps) {
  woken_.cancel();  // of a wait whose time was over at that very instant
  wait(sc_core::sc_time::from_value(ps), woken_);
  zynq_.scheduler.synchronise();
}

Json RemoteControl::wait_for(const Json& command) {
  const std::uint64_t limit = time_of(command, "timeout");
  const std::uint64_t every = std::max<std::uint64_t>(time_of(command, "every"), 1000);
  auto condition = std::make_unique<Condition>(static_cast<vp::SignalListener&>(*this));
  condition->expression = vp::Expression(text_of(command, "for"));
  condition->expression.bind([&](const std::string& name) {
    const std::size_t dot = name.find('.');
    const bool is_register = dot != std::string::npos && name.find('.', dot + 1) == name.npos &&
                             !dynamic_cast<vp::SignalBase*>(sc_core::sc_find_object(name.c_str()));
    Condition::Source source{};
    if (is_register) {
      source.address = DeviceNames(hardware_map(zynq_)).address_of(name);
      condition->polled = true;
    } else {
      source.signal = &signal_named(name);
    }
    condition->sources.push_back(source);
    return static_cast<std::uint32_t>(condition->sources.size() - 1);
  });
  const auto value_of = [this](const Condition::Source& source) -> long double {
    return source.signal ? number_in(*source.signal) : word_at(source.address);
  };
  std::vector<Condition::Source>& sources = condition->sources;
  for (Condition::Source& source : sources) source.now = source.before = value_of(source);
  met_ = condition->expression.holds(*condition);
  condition_ = std::move(condition);
  condition_->attach();
  for (std::uint64_t left = limit; !met_ && left > 0;) {
    const std::uint64_t step = condition_->polled ? std::min(left, every) : left;
    pass(step);
    left -= step;
    for (std::uint32_t i = 0; i < sources.size() && !met_; ++i) {
      if (!sources[i].signal) met_ = condition_->step(i, value_of(sources[i]));
    }
  }
  condition_.reset();
  return {{"met", std::exchange(met_, false)}};
}

Json RemoteControl::wait_for_text(const Json& command) {
  const std::uint64_t limit = time_of(command, "timeout");
  const std::string text = text_of(command, "text");
  if (text.empty()) throw vp::InputError("'text' is empty");
  met_ = std::any_of(console_.begin(), console_.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
  if (!met_) {
    text_ = text;
    pass(limit);
    text_.clear();
  }
  return {{"met", std::exchange(met_, false)}};
}

std::uint32_t RemoteControl::word_at(std::uint32_t address) {
  zynq_.settle();
  const std::optional<std::uint32_t> word = zynq_.peek(address);
  if (!word) throw vp::InputError("nothing answers at " + vp::hex(address));
  return *word;
}

Json RemoteControl::read(const Json& command) {
  const std::uint32_t first = DeviceNames(hardware_map(zynq_)).address_of(text_of(command, "at"));
  const std::uint64_t count = number_of(command, "words", 1 << 20);
  Json words = Json::array();
  for (std::uint64_t i = 0; i < count; ++i)
    words.push_back(word_at(static_cast<std::uint32_t>(first + 4 * i)));
  return {{"words", words}};
}

Json RemoteControl::write(const Json& command) {
  const std::uint32_t address = DeviceNames(hardware_map(zynq_)).address_of(text_of(command, "at"));
  const auto value = static_cast<std::uint32_t>(number_of(command, "value", 0xFFFF'FFFF));
  zynq_.settle();
  if (!zynq_.poke(address, value)) throw vp::InputError("nothing answers at " + vp::hex(address));
  return Json::object();
}

Json RemoteControl::drive(const Json& command) {
  vp::SignalBase& signal = signal_named(text_of(command, "name"));
  const std::uint64_t most =
      signal.width() >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << signal.width()) - 1;
  const std::uint64_t value = number_of(command, "value", most);
  if (!write_as<bool>(signal, value) && !write_as<std::uint8_t>(signal, value) &&
      !write_as<std::uint16_t>(signal, value) && !write_as<std::uint32_t>(signal, value) &&
      !write_as<std::uint64_t>(signal, value))
    throw vp::InputError(std::string("'") + signal.name() + "' can be read only");
  return Json::object();
}

Json RemoteControl::interrupt(const Json& command) {
  const auto id = static_cast<std::uint32_t>(number_of(command, "id", 95));
  if (id < 32) throw vp::InputError("interrupts with a wire from outside are 32 to 95");
  zynq_.ps.gic.set_wire(id, number_of(command, "level", 1) != 0);
  return Json::object();
}

// All words are looked at before the first one goes.
Json RemoteControl::send(const Json& command) {
  auto& source = stream_end_named<vp::StreamSource>(text_of(command, "name"), "stream source");
  const auto words = command.find("words");
  const auto is_word = [](const Json& word) {
    return word.is_number_unsigned() && word.get<std::uint64_t>() <= 0xFFFF'FFFF;
  };
  if (words == command.end() || !words->is_array() || words->empty() ||
      !std::all_of(words->begin(), words->end(), is_word))
    throw vp::InputError("needs 'words', whole numbers up to 4294967295, one at least");
  const bool last = number_of(command, "last", 1) != 0;
  for (std::size_t i = 0; i < words->size(); ++i)
    source.send((*words)[i].get<std::uint32_t>(), last && i + 1 == words->size());
  return Json::object();
}

Json RemoteControl::received(const Json& command) {
  auto& sink = stream_end_named<vp::StreamSink>(text_of(command, "name"), "stream sink");
  Json beats = Json::array();
  for (const vp::StreamSink::Beat& beat : sink.beats)
    beats.push_back({beat.cycle, beat.data, beat.last, beat.keep});
  sink.beats.clear();
  return {{"beats", beats}};
}

}  // namespace platform
