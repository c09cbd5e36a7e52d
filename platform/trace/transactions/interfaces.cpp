#include <trace/transactions/interfaces.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <unordered_map>

#include <trace/clock_choice.h>
#include <trace/transactions/signal_name.h>
#include <vp/error.h>
#include <vp/frame_gate.h>
#include <vp/text.h>

// Buses, found by the names of their signals or described by the user.

namespace platform::trace {

namespace {

using Direction = SignalName::Direction;

const std::vector<std::string> axi_roles = {
    "awid",   "awaddr",   "awlen",    "awsize",  "awburst", "awlock",  "awcache", "awprot",
    "awqos",  "awregion", "awuser",   "awvalid", "awready", "wid",     "wdata",   "wstrb",
    "wlast",  "wuser",    "wvalid",   "wready",  "bid",     "bresp",   "buser",   "bvalid",
    "bready", "arid",     "araddr",   "arlen",   "arsize",  "arburst", "arlock",  "arcache",
    "arprot", "arqos",    "arregion", "aruser",  "arvalid", "arready", "rid",     "rdata",
    "rresp",  "rlast",    "ruser",    "rvalid",  "rready"};
const std::vector<std::string> stream_roles = {"tvalid", "tready", "tdata", "tkeep", "tstrb",
                                               "tlast",  "tid",    "tdest", "tuser"};
const std::vector<std::string> apb_roles = {"psel",   "penable", "pready",  "pwrite", "paddr",
                                            "pwdata", "prdata",  "pslverr", "pstrb",  "pprot"};
const std::vector<std::string> wishbone_roles = {
    "cyc", "stb", "we", "ack", "err", "rty", "adr", "sel", "stall", "writedata", "readdata"};

/// How the last word of a role may end: most signals of a design have no role.
bool may_be_role(std::string_view word) {
  static constexpr std::array<std::string_view, 62> ends = {
      "valid", "ready", "id",     "addr",      "len",        "size", "burst",   "lock", "cache",
      "prot",  "qos",   "region", "user",      "data",       "strb", "last",    "resp", "keep",
      "dest",  "sel",   "nable",  "write",     "err",        "cyc",  "stb",     "we",   "ack",
      "rty",   "adr",   "stall",  "dat",       "wr",         "rd",   "w",       "r",    "mosi",
      "miso",  "copi",  "cipo",   "clk",       "sck",        "cs",   "csn",     "csb",  "ss",
      "ssn",   "n",     "scl",    "sda",       "tx",         "rx",   "txd",     "rxd",  "sout",
      "sin",   "f2p",   "irq",    "interrupt", "interrupts", "intr", "introut", "irqs"};
  const std::size_t letters = word.find_last_not_of("0123456789") + 1;
  const std::string_view named = word.substr(0, letters);
  return std::any_of(ends.begin(), ends.end(), [&](std::string_view end) {
    return vp::ends_with(word, end) || vp::ends_with(named, end);
  });
}

/// The signals by which buses are found.
bool is_anchor(std::string_view word) {
  static constexpr std::array<std::string_view, 18> ends = {
      "valid", "enable", "cyc", "scl", "mosi", "copi",      "tx",         "rx",   "txd",
      "rxd",   "sout",   "sin", "f2p", "irq",  "interrupt", "interrupts", "intr", "introut"};
  const std::size_t letters = word.find_last_not_of("0123456789") + 1;
  const std::string_view named = word.substr(0, letters);
  return word == "n" || word == "irqs" ||
         std::any_of(ends.begin(), ends.end(), [&](std::string_view end) {
           return vp::ends_with(word, end) || vp::ends_with(named, end);
         });
}

class InterfaceFinder {
 public:
  explicit InterfaceFinder(const TraceFile& file) : file_(file) {}

  FoundInterfaces run() {
    for (std::uint32_t i = 0; i < file_.paths().size(); ++i) {
      if (file_.variable(i).kind != vp::WaveVariable::Kind::bits || file_.variable(i).width == 0)
        continue;
      const SignalName name(file_.paths()[i]);
      const std::string last = name.words.empty() ? "" : name.words.back();
      if (!may_be_role(last)) continue;
      by_key_[name.key].push_back(i);
      if (is_anchor(last)) anchors_.push_back(i);
    }
    for (const std::uint32_t i : anchors_) look_at(i);
    std::stable_sort(found_.interfaces.begin(), found_.interfaces.end(),
                     [](const auto& a, const auto& b) { return a.name < b.name; });
    return std::move(found_);
  }

 private:
  void look_at(std::uint32_t i) {
    const SignalName name(file_.paths()[i]);
    for (const char* anchor : {"awvalid", "arvalid"}) {
      if (name.ends_in(anchor)) add_axi(i, anchor);
    }
    if (name.ends_in("tvalid")) add_stream(i);
    if (name.ends_in("penable")) add_apb(i);
    if (name.ends_in("cyc")) add_wishbone(i);
    if (name.ends_in("scl")) add_i2c(i);
    for (const char* anchor : {"mosi", "copi"}) {
      if (name.ends_in(anchor)) add_spi(i, anchor);
    }
    add_uart(i, name);
    add_interrupt(i, name);
  }

  /// The variable with this role on the bus of `stem`; of several the one whose path begins like
  /// that of `anchor`.
  std::optional<std::uint32_t> role(const std::string& stem, std::string_view role,
                                    std::uint32_t anchor) const {
    const auto found = by_key_.find(key_with(stem, role));
    if (found == by_key_.end()) return std::nullopt;
    const std::string& like = file_.paths()[anchor];
    const auto shared = [&](std::uint32_t one) {
      const std::string& path = file_.paths()[one];
      const std::size_t most = std::min(path.size(), like.size());
      return std::mismatch(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(most),
                           like.begin())
                 .first -
             path.begin();
    };
    return *std::max_element(
        found->second.begin(), found->second.end(),
        [&](std::uint32_t a, std::uint32_t b) { return shared(a) < shared(b); });
  }
  /// A bus with the roles that its signals have; null if it is there already.
  BusInterface* add(BusKind kind, std::uint32_t anchor, const std::string& anchor_role,
                    const std::vector<std::string>& roles) {
    const std::string stem = name_of(anchor).stem(anchor_role);
    BusInterface one;
    one.kind = kind;
    one.name = name_without(file_.paths()[anchor], anchor_role);
    if (!seen_.insert({static_cast<int>(kind), one.name}).second) return nullptr;
    one.roles[anchor_role] = anchor;
    for (const std::string& name : roles) {
      if (const auto variable = role(stem, name, anchor)) one.roles.emplace(name, *variable);
    }
    place(one, anchor);
    found_.interfaces.push_back(std::move(one));
    return &found_.interfaces.back();
  }
  void place(BusInterface& one, std::uint32_t anchor) const;
  void give_up(const std::string& reason) {
    found_.left_out.push_back({found_.interfaces.back().name, reason});
    found_.interfaces.pop_back();
  }
  /// Gives the bus up if it lacks a role, or one of its controls is wider than a bit.
  bool needs(const std::vector<std::string>& roles) {
    for (const std::string& role : roles) {
      const auto variable = found_.interfaces.back().role(role);
      if (!variable) {
        give_up("has no " + role);
        return false;
      }
      if (file_.variable(*variable).width != 1) {
        give_up(role + " has " + std::to_string(file_.variable(*variable).width) +
                " bits: several buses in one vector are not taken apart");
        return false;
      }
    }
    return true;
  }
  void add_axi(std::uint32_t i, const std::string& anchor);
  void add_stream(std::uint32_t i) {
    if (BusInterface* one = add(BusKind::axi_stream, i, "tvalid", stream_roles))
      needs(one->role("tready") ? std::vector<std::string>{"tvalid", "tready"}
                                : std::vector<std::string>{"tvalid"});
  }
  void add_apb(std::uint32_t i) {
    BusInterface* one = add(BusKind::apb, i, "penable", apb_roles);
    if (!one || !needs({"penable"})) return;
    if (!one->role("psel")) give_up("has no psel");
  }
  void add_wishbone(std::uint32_t i);
  void add_i2c(std::uint32_t i);
  void add_spi(std::uint32_t i, const std::string& anchor);
  void add_uart(std::uint32_t i, const SignalName& name);
  void add_interrupt(std::uint32_t i, const SignalName& name);
  SignalName name_of(std::uint32_t variable) const { return SignalName(file_.paths()[variable]); }
  /// Without settings and roles but for one line.
  void add_line(BusKind kind, std::uint32_t i) {
    if (file_.variable(i).width == 0) return;
    BusInterface one;
    one.kind = kind;
    one.name = file_.paths()[i];
    one.roles["line"] = i;
    place(one, i);
    found_.interfaces.push_back(std::move(one));
  }

  const TraceFile& file_;
  std::vector<std::uint32_t> anchors_;
  std::unordered_map<std::string, std::vector<std::uint32_t>> by_key_;
  std::set<std::pair<int, std::string>> seen_;
  FoundInterfaces found_;
};

/// The scope, and whose ports they are.
void InterfaceFinder::place(BusInterface& one, std::uint32_t anchor) const {
  const std::string& path = file_.paths()[anchor];
  const std::string_view level = scope_of(path), above = scope_of(one.name);
  one.scope = one.name == level || above.empty() ? level : above;
  const std::string own = vp::lower(leaf_of(one.name));
  const std::string word = own.substr(0, own.find('_'));
  const auto is = [&](const std::string& letter, const char* const* whole) {
    for (; *whole; ++whole) {
      if (word == *whole) return true;
    }
    return word.substr(0, 1) == letter &&
           word.find_first_not_of("0123456789", 1) == std::string::npos;
  };
  static const char* const managers[] = {"maxi",    "maxis", "mst",  "master",
                                         "manager", "wbm",   nullptr};
  static const char* const subordinates[] = {"saxi",        "saxis", "slv",  "slave",
                                             "subordinate", "wbs",   nullptr};
  if (word.empty()) return;
  if (is("m", managers)) one.side = BusInterface::Side::manager;
  if (is("s", subordinates)) one.side = BusInterface::Side::subordinate;
}

void InterfaceFinder::add_axi(std::uint32_t i, const std::string& anchor) {
  BusInterface* one = add(BusKind::axi4, i, anchor, axi_roles);
  if (!one) return;
  const auto has = [&](const char* role) { return one->role(role).has_value(); };
  const bool bursts = has("awlen") || has("arlen") || has("wlast") || has("rlast");
  if (!bursts) one->kind = BusKind::axi4_lite;
  std::vector<std::string> controls;
  for (const auto& [first, second] : {std::pair("awvalid", "awready"),
                                      {"wvalid", "wready"},
                                      {"bvalid", "bready"},
                                      {"arvalid", "arready"},
                                      {"rvalid", "rready"}}) {
    const bool writes = first[0] != 'r' && first[1] != 'r';
    if (!has(writes ? "awvalid" : "arvalid")) continue;
    controls.insert(controls.end(), {first, second});
  }
  needs(controls);
}

void InterfaceFinder::add_wishbone(std::uint32_t i) {
  const std::string stem = name_of(i).stem("cyc");
  if (!role(stem, "stb", i)) return;  // another cycle
  BusInterface* one = add(BusKind::wishbone, i, "cyc", wishbone_roles);
  if (!one || !needs({"cyc", "stb", "ack"})) return;
  const auto take = [&](const char* role_name, std::initializer_list<const char*> spellings) {
    for (const char* spelling : spellings) {
      if (one->role(role_name)) return;
      if (const auto variable = role(stem, spelling, i)) one->roles.emplace(role_name, *variable);
    }
  };
  take("adr", {"addr"});
  take("writedata", {"datw", "datwr", "datmosi", "wdata", "wdat", "dw"});
  take("readdata", {"datr", "datrd", "datmiso", "rdata", "rdat", "dr", "idata", "idat"});
  // `dat_o` is written by the side whose `cyc` goes out, and read by the other one.
  const bool manager = name_of(i).direction == Direction::out;
  for (const char* spelling : {"dat", "data"}) {
    const auto both = by_key_.find(key_with(stem, spelling));
    if (both == by_key_.end()) continue;
    for (const std::uint32_t variable : both->second) {
      const Direction direction = name_of(variable).direction;
      if (direction == Direction::none) continue;
      one->roles.emplace((direction == Direction::out) == manager ? "writedata" : "readdata",
                         variable);
    }
  }
  if (name_of(i).direction == Direction::out) one->side = BusInterface::Side::manager;
  if (name_of(i).direction == Direction::in) one->side = BusInterface::Side::subordinate;
}

void InterfaceFinder::add_i2c(std::uint32_t i) {
  const std::string stem = name_of(i).stem("scl");
  const auto lines = by_key_.find(key_with(stem, "sda"));
  if (lines == by_key_.end() || file_.variable(i).width != 1) return;
  // Of `scl_i` and `scl_o` the first is what the wire shows.
  const auto wire = [&](const std::vector<std::uint32_t>& names) {
    return *std::max_element(names.begin(), names.end(), [&](std::uint32_t a, std::uint32_t b) {
      const auto rank = [&](std::uint32_t one) {
        return name_of(one).direction == Direction::none ? 2
               : name_of(one).direction == Direction::in ? 1
                                                         : 0;
      };
      return rank(a) < rank(b);
    });
  };
  const auto& clocks = by_key_.at(name_of(i).key);
  if (BusInterface* one = add(BusKind::i2c, i, "scl", {})) {
    one->roles["scl"] = wire(clocks);
    one->roles["sda"] = wire(lines->second);
    needs({"scl", "sda"});
  }
}

void InterfaceFinder::add_spi(std::uint32_t i, const std::string& anchor) {
  const std::string stem = name_of(i).stem(anchor);
  const auto first = [&](std::initializer_list<const char*> spellings) {
    std::optional<std::uint32_t> found;
    for (const char* spelling : spellings) {
      if (!found) found = role(stem, spelling, i);
    }
    return found;
  };
  const auto clock = first({"sclk", "sck", "clk"});
  if (!clock) return;
  BusInterface* one = add(BusKind::spi, i, anchor, {});
  if (!one) return;
  one->roles = {{"mosi", i}, {"sclk", *clock}};
  if (const auto miso = first({"miso", "cipo"})) one->roles["miso"] = *miso;
  if (const auto select = first({"csn", "cs", "csb", "ncs", "ssn", "ss", "nss", "ssel"}))
    one->roles["cs"] = *select;
  if (one->role("cs")) {
    needs({"mosi", "sclk", "cs"});
  } else {
    needs({"mosi", "sclk"});
  }
}

void InterfaceFinder::add_uart(std::uint32_t i, const SignalName& name) {
  const std::string& last = name.words.back();
  if (file_.variable(i).width != 1) return;
  const bool sure = last == "txd" || last == "rxd";
  const bool maybe = last == "tx" || last == "rx" || last == "sout" || last == "sin" ||
                     last == "uarttx" || last == "uartrx";
  const auto& words = name.words;
  const bool uart = std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word.find("uart") != std::string::npos || word == "serial";
  });
  if (sure || (maybe && uart)) add_line(BusKind::uart, i);
}

void InterfaceFinder::add_interrupt(std::uint32_t i, const SignalName& name) {
  static constexpr std::array<std::string_view, 6> words = {"irq",  "irqs",    "interrupt",
                                                            "intr", "introut", "interrupts"};
  const std::string& last = name.words.back();
  const auto is_word = [&](std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  const std::string stem = last.substr(0, last.find_last_not_of("0123456789") + 1);
  const auto& all = name.words;
  const bool f2p = last == "f2p" && all.size() > 1 && all[all.size() - 2] == "irq";
  const bool low = last == "n" && all.size() > 1 && is_word(all[all.size() - 2]);
  if (!is_word(stem) && !f2p && !low) return;
  add_line(BusKind::irq, i);
  // `n_irq` and `irq_n` are active low.
  const bool begins_low = all.size() > 1 && all[all.size() - 2] == "n";
  if (low || begins_low) found_.interfaces.back().settings["active"] = "low";
}

}  // namespace

const char* bus_kind_name(BusKind kind) {
  static constexpr std::array<const char*, bus_kinds> names = {
      "axi4", "axi4-lite", "axi-stream", "apb", "wishbone", "uart", "i2c", "spi", "irq"};
  return names[static_cast<std::size_t>(kind)];
}

BusKind bus_kind_named(const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < bus_kinds; ++i) {
    names.emplace_back(bus_kind_name(static_cast<BusKind>(i)));
    if (names.back() == name) return static_cast<BusKind>(i);
  }
  const std::string near = vp::nearest_match(name, names);
  throw vp::InputError("'" + vp::excerpt(name) + "' is no kind of bus" +
                       (near.empty() ? "" : ": did you mean '" + near + "'?") + " (" +
                       vp::join(names, ", ") + ")");
}

const std::vector<std::string>& roles_of(BusKind kind) {
  static const std::vector<std::string> line = {"line"}, i2c = {"scl", "sda"},
                                        spi = {"sclk", "mosi", "miso", "cs"};
  switch (kind) {
    case BusKind::axi4:
    case BusKind::axi4_lite:
      return axi_roles;
    case BusKind::axi_stream:
      return stream_roles;
    case BusKind::apb:
      return apb_roles;
    case BusKind::wishbone:
      return wishbone_roles;
    case BusKind::i2c:
      return i2c;
    case BusKind::spi:
      return spi;
    case BusKind::uart:
    case BusKind::irq:
      break;
  }
  return line;
}

FoundInterfaces find_interfaces(const TraceFile& file) {
  return InterfaceFinder(file).run();
}

}  // namespace platform::trace
