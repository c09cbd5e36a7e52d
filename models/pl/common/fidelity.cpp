#include <pl/common/fidelity.h>

#include <algorithm>

#include <vp/error.h>
#include <vp/text.h>

namespace pl {

namespace {

std::vector<std::string> names_of(const std::vector<ModelTraits>& models) {
  std::vector<std::string> names;
  names.reserve(models.size());
  for (const ModelTraits& model : models) names.push_back(model.name);
  return names;
}

bool goes(Passage given, Passage taken) {
  return (given.pixels && taken.pixels) || (given.frames && taken.frames);
}

/// Any but 0 and 1: random values, the same in every run.
constexpr std::uint64_t usual_seed = 1000;

std::string words(Passage image) {
  return image.pixels ? "pixels one by one" : "whole frames";
}

}  // namespace

std::optional<RtlFile> RtlFile::parse(const std::string& text) {
  const auto behind = [&text](const std::string& prefix) {
    return text.compare(0, prefix.size(), prefix) == 0
               ? std::optional<std::string>(text.substr(prefix.size()))
               : std::nullopt;
  };
  if (const auto folder = behind("vectors:")) return RtlFile{*folder, Use::vectors};
  const auto beside = behind("lockstep:");
  const std::string path = beside.value_or(text), ending = ".so";
  const bool ends_so = path.size() > ending.size() &&
                       path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
  if (!ends_so && path.find('/') == std::string::npos) return std::nullopt;
  return RtlFile{path, beside ? Use::lockstep : Use::in_place};
}

ModelName::ModelName(const std::string& instance, std::string otherwise,
                     const std::vector<std::string>& names, bool takes_rtl)
    : ParameterBase(instance.c_str(), vp::Unit::none, vp::Source::decision,
                    "how this IP is modelled: clock by clock, whole frames, or RTL"),
      value_(otherwise) {
  const vp::Setting* given = setting();
  if (given && takes_rtl && RtlFile::parse(given->text)) {
    value_ = given->text;
  } else if (given) {
    value_ = names[choice(*given, names)];
  }
  publish(value_, std::move(otherwise),
          vp::one_of(names) +
              (takes_rtl ? ", or RTL: file .so, lockstep:file .so, or vectors:folder" : ""));
  follows("fidelity");
}

ChoiceBase::ChoiceBase(const std::string& instance, std::vector<ModelTraits> traits, bool takes_rtl,
                       Fidelity otherwise, const Feeds& feeds)
    : traits_(std::move(traits)),
      parameter_(instance, usual(otherwise, feeds), names_of(traits_), takes_rtl) {
  while (chosen_ < traits_.size() && traits_[chosen_].name != parameter_.get()) ++chosen_;
  // RTL has the pins of the clocked model.
  if (chosen_ == traits_.size()) {
    ModelTraits rtl{parameter_.get(), traits_.front().takes, traits_.front().gives};
    file_ = RtlFile::parse(rtl.name);
    if (file_ && file_->use == RtlFile::Use::in_place) rtl.takes.frames = rtl.gives.frames = false;
    traits_.push_back(rtl);
  }
  if (file_ && file_->use != RtlFile::Use::vectors) {
    seed_ = std::make_unique<vp::Parameter<std::uint64_t>>(
        (instance + "_seed").c_str(), usual_seed, vp::Unit::none, vp::Source::decision,
        "how registers without reset start in the RTL of " + instance +
            ": 0 zeros, 1 ones, otherwise random values of this seed");
    file_->seed = *seed_;
  }
  for (const ChoiceBase* other : feeds) check(*other);
}

std::string ChoiceBase::usual(Fidelity otherwise, const Feeds& others) const {
  const std::string wish = otherwise == Fidelity::tlm ? "tlm" : "clocked";
  std::string usual;
  for (const ModelTraits& model : traits_) {
    if (!feeds(model, others)) continue;
    if (usual.empty() || model.name == wish) usual = model.name;
  }
  return usual.empty() ? traits_.front().name : usual;
}

bool ChoiceBase::feeds(const ModelTraits& model, const Feeds& others) const {
  return std::all_of(others.begin(), others.end(), [&](const ChoiceBase* other) {
    return goes(model.gives, other->traits_[other->chosen_].takes);
  });
}

void ChoiceBase::check(const ChoiceBase& other) const {
  const ModelTraits &mine = traits_[chosen_], &theirs = other.traits_[other.chosen_];
  if (goes(mine.gives, theirs.takes)) return;
  std::vector<std::string> ways;
  for (const ModelTraits& model : other.traits_) {
    if (goes(mine.gives, model.takes))
      ways.push_back(std::string(other.parameter_.name()) + "=" + model.name);
  }
  throw vp::InputError(std::string(parameter_.name()) + " = " + mine.name + " does not go with " +
                       other.parameter_.name() + " = " + theirs.name + ": one gives " +
                       words(mine.gives) + ", the other takes " + words(theirs.takes) +
                       "; choose " + (ways.empty() ? "another model" : vp::one_of(ways)));
}

}  // namespace pl
