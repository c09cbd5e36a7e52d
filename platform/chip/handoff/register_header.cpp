#include <chip/handoff/described_register.h>
#include <vp/error.h>
#include <vp/text.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>

// The header that Vitis HLS makes of a control interface, x<ip>_hw.h: registers and bits in
// comments, their names in #define X<IP>_<BUNDLE>_ADDR_<NAME>.
namespace platform::handoff {

namespace {

class Header {
 public:
  Header(const std::string& text, std::string origin) : lines_(text), origin_(std::move(origin)) {}

  std::vector<RegisterMap> read() {
    for (std::string line; std::getline(lines_, line);) {
      ++number_;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      read_line(line);
    }
    for (auto& [bundle, names] : names_) add_bundle(bundle, names);
    if (maps_.empty()) {
      throw vp::InputError(origin_ +
                           ": no '#define X<IP>_<BUNDLE>_ADDR_<NAME> 0x..' in it, as headers "
                           "of Vitis HLS have: is it x<ip>_hw.h?");
    }
    return std::move(maps_);
  }

 private:
  /// What comments say of an address, and where.
  struct Described {
    std::string text;
    std::vector<DescribedRegister::Field> fields;
  };
  struct Name {
    std::string name;
    std::uint64_t offset;
    std::string place;
  };

  std::string place() const { return origin_ + ":" + std::to_string(number_); }

  void read_line(const std::string& line) {
    static const std::regex bundle(R"(//\s*([A-Za-z_]\w*)\s*)"),
        address(R"(//\s*(0x[0-9A-Fa-f]+)\s*:\s*(.*))"),
        bit(R"(//\s*bit\s+(\d+)(?:\s*~\s*(\d+))?\s*-\s*(.*))"),
        definition(R"(\s*#define\s+X\w*?_ADDR_(\w+)\s+(\S+).*)"),
        start(R"(\s*#define\s+(X\w*?)_ADDR_.*)");
    std::smatch match;
    if (std::regex_match(line, match, bundle)) {
      bundle_ = match[1];
    } else if (std::regex_match(line, match, address)) {
      at_ = &described_[bundle_][register_number(match[1], place())];
      at_->text = match[2];
    } else if (at_ && std::regex_match(line, match, bit)) {
      add_bits(match[1], match[2], match[3]);
    } else if (std::regex_match(line, match, definition)) {
      const std::string name = match[1], value = match[2];
      std::regex_match(line, match, start);
      add_name(match[1], name, value);
    }
  }

  /// "ap_start (Read/Write/COH)": "COR" is cleared by reading, "TOW" toggles.
  void add_bits(const std::string& first, const std::string& second, const std::string& what) {
    const std::uint64_t one = register_number(first, place());
    const std::uint64_t other = second.empty() ? one : register_number(second, place());
    const std::uint64_t low = std::min(one, other), high = std::max(one, other);
    constexpr std::uint64_t most = 63;
    if (high > most)
      throw vp::InputError(place() + ": bit " + std::to_string(high) + " of a register");
    DescribedRegister::Field field;
    field.low = static_cast<unsigned>(low);
    field.bits = static_cast<unsigned>(high - low + 1);
    const std::size_t open = what.rfind('(');
    field.name = vp::trim(
        what.substr(0, what.find('[') == what.npos ? open : std::min(open, what.find('['))));
    const std::string how = open == what.npos ? "" : what.substr(open);
    const bool reads = how.find("Read") != how.npos, writes = how.find("Write") != how.npos;
    field.access = how.find("TOW") != how.npos ? "w1t" : !writes ? "ro" : reads ? "rw" : "wo";
    for (const auto& [sign, words] : {std::pair{"COR", "cleared by reading"},
                                      {"COH", "cleared by the hardware's handshake"},
                                      {"SC", "clears itself"}}) {
      if (how.find(std::string("/") + sign) != how.npos) field.documentation = words;
    }
    at_->fields.push_back(std::move(field));
  }

  /// `start` is X<IP>_<BUNDLE>.
  void add_name(const std::string& start, const std::string& name, const std::string& value) {
    std::string bundle;
    for (const auto& [known, described] : described_) {
      std::string ending = "_" + known;
      std::transform(ending.begin(), ending.end(), ending.begin(),
                     [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      const bool ends = start.size() > ending.size() &&
                        start.compare(start.size() - ending.size(), ending.size(), ending) == 0;
      if (ends && known.size() >= bundle.size()) bundle = known;
    }
    names_[bundle].push_back({name, register_number(value, place()), place()});
  }

  /// A memory has two addresses, <NAME>_BASE and <NAME>_HIGH: the words between are its elements.
  void add_bundle(const std::string& bundle, const std::vector<Name>& names) {
    RegisterMap map{bundle, {}};
    for (const Name& one : names) {
      const auto is = [&](const char* end) {
        const std::string ending = end;
        return one.name.size() > ending.size() &&
               one.name.compare(one.name.size() - ending.size(), ending.size(), ending) == 0;
      };
      const auto last = std::find_if(names.begin(), names.end(), [&](const Name& other) {
        return is("_BASE") && other.name == one.name.substr(0, one.name.size() - 4) + "HIGH";
      });
      if (last != names.end()) {
        add_memory(map, one, last->offset);
      } else if (!is("_HIGH")) {
        add_one(map, bundle, one);
      }
    }
    maps_.push_back(std::move(map));
  }

  void add_memory(RegisterMap& map, const Name& first, std::uint64_t last) {
    if (last < first.offset || (last - first.offset) / 4 >= most_registers)
      throw vp::InputError(first.place + ": memory '" + first.name +
                           "' does not end behind its start");
    const std::string name = first.name.substr(0, first.name.size() - 5);
    for (std::uint64_t at = first.offset; at <= last; at += 4) {
      DescribedRegister word;
      word.name = name + "[" + std::to_string((at - first.offset) / 4) + "]";
      word.offset = at;
      add_register(map, std::move(word), first.place);
    }
  }

  void add_one(RegisterMap& map, const std::string& bundle, const Name& one) {
    DescribedRegister found;
    found.name = one.name;
    found.offset = one.offset;
    const auto said = described_[bundle].find(one.offset);
    if (said != described_[bundle].end()) {
      found.documentation = said->second.text;
      found.fields = said->second.fields;
      const auto readable = [](const DescribedRegister::Field& f) { return f.access == "ro"; };
      if (!found.fields.empty() && std::all_of(found.fields.begin(), found.fields.end(), readable))
        found.access = "ro";
    }
    add_register(map, std::move(found), one.place);
  }

  std::istringstream lines_;
  const std::string origin_;
  unsigned number_ = 0;
  std::string bundle_;
  Described* at_ = nullptr;
  std::map<std::string, std::map<std::uint64_t, Described>> described_;  ///< by bundle and address
  std::map<std::string, std::vector<Name>> names_;                       ///< by bundle
  std::vector<RegisterMap> maps_;
};

}  // namespace

std::vector<RegisterMap> registers_of_header(const std::string& text, const std::string& origin) {
  return Header(text, origin).read();
}

}  // namespace platform::handoff
