#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pl/common/geometry.h>
#include <vp/clock.h>
#include <vp/parameter.h>

namespace pl {

/// How an IP is modelled if nothing else is asked for. Results and times are the same.
enum class Fidelity {
  clocked,  ///< clock by clock, all ports alive
  tlm,      ///< whole frames at once, with the clock of every packet
};

/// How the image goes from one IP to the next.
struct Passage {
  bool pixels = false;  ///< one by one, on signals
  bool frames = false;  ///< on a FrameChannel
};
constexpr Passage no_image{}, by_pixel{true, false}, by_frame{false, true}, both_ways{true, true};

/// What every model of an IP is built with; all else is bound to its ports.
struct Site {
  vp::Clock& clk;
  Geometry geometry;
  vp::Clock* m_clk =
      nullptr;  ///< of the module that takes the stream of an IP that lies between two clocks
};

/// What the choice among the models of an IP depends on.
struct ModelTraits {
  std::string name;  ///< as `fidelity.<ip>` says it
  Passage takes, gives;
};

/// One way to model an `Ip`, which is the class with its ports.
template <class Ip>
struct Model : ModelTraits {
  using Make = std::function<std::unique_ptr<Ip>(const char* name, const Site& site)>;

  Model(ModelTraits traits, Make make_model)
      : ModelTraits(std::move(traits)), make(std::move(make_model)) {}
  Make make;
};

/// A model that is the class `Module`.
template <class Ip, class Module>
Model<Ip> model(std::string name, Passage takes, Passage gives) {
  return {{std::move(name), takes, gives}, [](const char* instance, const Site& site) {
            return std::make_unique<Module>(instance, site);
          }};
}

/// What `fidelity.IP` names besides models: "corner.so", RTL in place of the IP;
/// "lockstep:corner.so", RTL beside its clocked model, which it must equal; "vectors:folder", where
/// its clocked model leaves stimulus and response for the benches of RTL.
struct RtlFile {
  enum class Use { in_place, lockstep, vectors };
  std::string path;
  Use use = Use::in_place;
  /// Start of registers without reset: 0 zeros, 1 ones, otherwise random values.
  std::uint64_t seed = 0;

  /// None if `text` names no such thing: it has no folder in it, and does not end in .so.
  static std::optional<RtlFile> parse(const std::string& text);
};

/// All models of an IP, "clocked" first. The IP's folder lists its own; a design from outside may
/// add others before the logic is built.
template <class Ip>
class Models {
 public:
  /// Makes the IP of RTL in a shared object (rtl_model.h).
  using MakeRtl =
      std::function<std::unique_ptr<Ip>(const char* name, const Site& site, const RtlFile& rtl)>;

  /// `ip`: its name, which is that of the instance and of its key in `fidelity` where a design has
  /// only one. `rtl`: empty for an IP in whose place no RTL can stand.
  Models(std::string ip, std::initializer_list<Model<Ip>> models, MakeRtl rtl = {})
      : make_rtl(std::move(rtl)), ip_(std::move(ip)), models_(models) {}

  const MakeRtl make_rtl;

  /// Throws std::logic_error for a name that there is.
  void add(Model<Ip> model) {
    for (const Model<Ip>& known : models_) {
      if (known.name == model.name)
        throw std::logic_error("there is a model '" + model.name + "' of " + ip_);
    }
    models_.push_back(std::move(model));
  }
  const std::string& ip() const { return ip_; }
  const std::vector<Model<Ip>>& list() const { return models_; }

 private:
  std::string ip_;
  std::vector<Model<Ip>> models_;
};

/// `fidelity.<ip>`: the name of a model, or RtlFile.
class ModelName : public vp::ParameterBase {
 public:
  ModelName(const std::string& instance, std::string otherwise,
            const std::vector<std::string>& names, bool takes_rtl);
  const std::string& get() const { return value_; }

 private:
  std::string value_;
};

/// The part of Choice that does not depend on the IP.
class ChoiceBase {
 public:
  /// To whom its image goes.
  using Feeds = std::vector<const ChoiceBase*>;

  Passage gives() const { return traits_[chosen_].gives; }
  /// Its key.
  std::string name() const { return parameter_.name(); }
  /// No model of the list, but an RtlFile.
  bool is_file() const { return file_.has_value(); }

 protected:
  /// `traits` is never empty.
  ChoiceBase(const std::string& instance, std::vector<ModelTraits> traits, bool takes_rtl,
             Fidelity otherwise, const Feeds& feeds);
  std::size_t chosen() const { return chosen_; }
  const std::string& text() const { return parameter_.get(); }
  /// Empty for a model of the list.
  const std::optional<RtlFile>& file() const { return file_; }

 private:
  std::string usual(Fidelity otherwise, const Feeds& feeds) const;
  bool feeds(const ModelTraits& model, const Feeds& others) const;
  void check(const ChoiceBase& other) const;

  std::vector<ModelTraits> traits_;
  ModelName parameter_;
  std::unique_ptr<vp::Parameter<std::uint64_t>> seed_;  ///< null where no RTL runs
  std::optional<RtlFile> file_;
  std::size_t chosen_ = 0;
};

/// Which model of an IP is built: a member of the module `fidelity`.
///
/// Not configured, it is that of the whole logic, unless that does not go with the IP that it
/// feeds: then it is the first model that does.
template <class Ip>
class Choice : public ChoiceBase {
 public:
  /// What it feeds has chosen before. Throws vp::InputError if that cannot take what a configured
  /// model gives.
  Choice(const Models<Ip>& models, Fidelity otherwise, const Feeds& feeds = {})
      : Choice(models.ip(), models, otherwise, feeds) {}
  /// Of one of several instances of the IP.
  Choice(const std::string& instance, const Models<Ip>& models, Fidelity otherwise,
         const Feeds& feeds = {})
      : ChoiceBase(instance, {models.list().begin(), models.list().end()},
                   models.make_rtl != nullptr, otherwise, feeds),
        instance_(instance) {
    if (chosen() < models.list().size()) {
      make_ = models.list()[chosen()].make;
    } else {
      make_ = [make = models.make_rtl, rtl = *file()](const char* name, const Site& site) {
        return make(name, site, rtl);
      };
    }
  }

  std::unique_ptr<Ip> make(const Site& site) const { return make_(instance_.c_str(), site); }

 private:
  std::string instance_;
  typename Model<Ip>::Make make_;
};

}  // namespace pl
