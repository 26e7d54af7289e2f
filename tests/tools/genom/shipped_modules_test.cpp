// SPDX-License-Identifier: BSD-3-Clause
// The descriptions of the paper's modules say what is implemented: requests with types and inputs, tasks, posters,
// reports; docs/requests.md is generated from them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "core/file_contents.hpp"
#include "modules/description/parser.hpp"
#include "modules/genom/module.hpp"
#include "modules/ndd/ndd.hpp"
#include "modules/pom/pom.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/rflex/rflex.hpp"
#include "tools/genom/generators.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::tools {
namespace {

using description::Description;
using description::Request;

// The structure of a value with declared fields, in the words of description::structure().
template <class T>
std::string structure_of();

template <class T>
struct ElementsOf : std::false_type {};
template <class T, std::size_t N>
struct ElementsOf<std::array<T, N>> : std::true_type {
  static std::string text() { return "[" + std::to_string(N) + "]" + structure_of<T>(); }
};
template <class T, std::size_t N>
struct ElementsOf<Bounded<T, N>> : std::true_type {
  static std::string text() { return "{size: u32, items: [" + std::to_string(N) + "]" + structure_of<T>() + "}"; }
};

template <class T>
std::string structure_of() {
  if constexpr (HasFields<T>) {
    std::string text;
    T value{};
    for_each_field(value, [&](std::string_view name, const auto& member) {
      text +=
          (text.empty() ? "" : ", ") + std::string(name) + ": " + structure_of<std::remove_cvref_t<decltype(member)>>();
    });
    return "{" + text + "}";
  } else if constexpr (ElementsOf<T>::value) {
    return ElementsOf<T>::text();
  } else if constexpr (std::is_enum_v<T>) {
    return structure_of<std::underlying_type_t<T>>();
  } else if constexpr (std::is_same_v<T, bool>) {
    return "bool";
  } else if constexpr (std::is_same_v<T, Time> || std::is_same_v<T, Duration>) {
    return "i64";
  } else if constexpr (std::is_same_v<T, Point>) {
    return "{x: f64, y: f64}";
  } else if constexpr (std::is_same_v<T, Pose>) {
    return "{x: f64, y: f64, heading: f64}";
  } else {
    return (std::is_floating_point_v<T> ? "f" : std::is_signed_v<T> ? "i" : "u") + std::to_string(8 * sizeof(T));
  }
}

/// A type of the implementation that stands for one of C.
struct Implemented {
  std::string structure;
  std::function<bool(const genom::RequestType& request)> is_input_of;
  std::function<bool(genom::PosterBase& poster)> is_value_of;
};

template <class T>
bool accepts(const genom::RequestType& request) {
  if constexpr (sizeof(T) <= genom::payload_bytes_max) return request.accepts(genom::Payload(T{}));
  return false;
}

template <class T>
Implemented implemented() {
  return {structure_of<T>(), accepts<T>, [](genom::PosterBase& poster) { return poster.type() == typeid(T); }};
}
std::map<std::string, Implemented> implemented_types() {
  using namespace posters;
  return {{"BASE_COMMAND", implemented<BaseCommand>()},
          {"BATTERY", implemented<Battery>()},
          {"BUMPERS", implemented<world::Bumpers::Reading>()},
          {"ECHOES", implemented<Echoes>()},
          {"FUSED_POSITION", implemented<FusedPosition>()},
          {"GO_TO_INPUT", implemented<GoToInput>()},
          {"GYRO_BIAS", implemented<rflex::GyroBias>()},
          {"INERTIAL", implemented<world::Imu::Reading>()},
          {"KNOWN_POSE", implemented<KnownPose>()},
          {"LASER_COMMAND", implemented<LaserCommand>()},
          {"LOCALISATION", implemented<Localisation>()},
          {"ODOMETRY", implemented<Odometry>()},
          {"POSITION_FIX", implemented<world::Gps::Reading>()},
          {"SEGMENTS", implemented<Segments>()},
          {"SEGMENT_MAP", implemented<SegmentMap>()},
          {"SONARS", implemented<Sonars>()},
          {"SOURCE_INPUT", implemented<pom::SourceInput>()},
          {"SPEED_INPUT", implemented<rflex::SpeedInput>()},
          {"SPEED_REFERENCE", implemented<SpeedReference>()}};
}

std::string root() {
  const char* root = std::getenv("WAITPOINT_ROOT");
  return root != nullptr ? root : ".";
}
const std::vector<std::string> module_names = {"ndd", "pom", "rflex", "segloc", "sick"};
Description described(const std::string& name) {
  return description::read_description(root() + "/modules/" + name + "/" + name + ".gen");
}

/// The paper's modules on one robot, not started.
class ShippedModules : public testing::Test {
 protected:
  ShippedModules() {
    for (const genom::ModuleType& type : papers_modules()) {
      setups_.push_back(
          std::make_unique<genom::ModuleSetup>(genom::ModuleSetup{names_, type.name, genom::Settings(), nullptr}));
      modules_.push_back(type.make(*setups_.back()));
    }
  }

  genom::NameSpace names_;
  std::vector<std::unique_ptr<genom::ModuleSetup>> setups_;
  std::vector<std::unique_ptr<genom::Module>> modules_;
  const std::map<std::string, Implemented> types_ = implemented_types();
};

void expect_same_request(const Request& request, const genom::RequestType& found,
                         const std::map<std::string, Implemented>& types) {
  const genom::RequestKind kinds[] = {genom::RequestKind::control, genom::RequestKind::execution,
                                      genom::RequestKind::init};
  EXPECT_EQ(kinds[static_cast<int>(request.kind)], found.kind);
  EXPECT_EQ(request.exec_task ? request.exec_task->text : "", found.task != nullptr ? found.task->name() : "");
  std::set<std::string> interrupts;
  for (const description::Name& name : request.interrupts) interrupts.insert(name.text);
  EXPECT_EQ(interrupts, std::set<std::string>(found.interrupts.begin(), found.interrupts.end()));
  EXPECT_EQ(found.accepts(genom::Payload(genom::Nothing())), !request.input);
  if (request.input) {
    ASSERT_TRUE(types.contains(request.input->type->name)) << request.input->type->name;
    EXPECT_TRUE(types.at(request.input->type->name).is_input_of(found));
  }
}

TEST_F(ShippedModules, HaveTheDescribedRequests) {
  for (const std::string& name : module_names) {
    const Description described_module = described(name);
    const genom::Module& module = *names_.find_module(name);
    EXPECT_EQ(module.requests().size(), described_module.requests.size() + 1) << name << ": and Abort";
    EXPECT_EQ(genom::module_of(module.report(genom::StandardReport::system_error)), described_module.number);
    for (const Request& request : described_module.requests) {
      SCOPED_TRACE(name + "." + request.name.text);
      const genom::RequestType* found = module.find_request(request.name.text);
      ASSERT_NE(found, nullptr);
      expect_same_request(request, *found, types_);
    }
  }
}

TEST_F(ShippedModules, HaveTheDescribedTypes) {
  for (const std::string& name : module_names) {
    const Description described_module = described(name);
    std::vector<description::TypeRef> used;
    for (const Request& request : described_module.requests)
      for (const auto* parameter : {&request.input, &request.output})
        if (*parameter) used.push_back((*parameter)->type);
    for (const description::Poster& poster : described_module.posters) used.push_back(poster.data.at(0).type);
    for (const description::TypeRef& type : used) {
      ASSERT_TRUE(types_.contains(type->name)) << type->name;
      EXPECT_EQ(structure(*type), types_.at(type->name).structure) << type->name;
    }
  }
}

TEST_F(ShippedModules, HaveTheDescribedPosters) {
  for (const std::string& name : module_names) {
    const Description described_module = described(name);
    std::set<std::string> written = {name + ".control"};
    for (const description::Poster& poster : described_module.posters) {
      const std::string full = name + "." + poster.name.text;
      written.insert(full);
      genom::PosterBase* found = names_.find_poster(full);
      ASSERT_NE(found, nullptr) << full;
      // The infrared range finders' poster has a type of its own, with the same fields.
      if (full == "rflex.infrareds")
        EXPECT_EQ(found->type(), typeid(posters::Infrareds));
      else
        EXPECT_TRUE(types_.at(poster.data.at(0).type->name).is_value_of(*found)) << full;
    }
    std::set<std::string> found;
    for (const auto& [full, poster] : names_.posters())
      if (poster->writer() == name) found.insert(full);
    EXPECT_EQ(found, written);
  }
  EXPECT_EQ(structure_of<posters::Infrareds>(), types_.at("SONARS").structure);
}

TEST_F(ShippedModules, HaveTheDescribedTasks) {
  for (const std::string& name : module_names) {
    const Description described_module = described(name);
    const genom::Module& module = *names_.find_module(name);
    ASSERT_EQ(module.tasks().size(), described_module.tasks.size());
    for (std::size_t i = 0; i < module.tasks().size(); ++i) {
      const description::ExecTask& task = described_module.tasks[i];
      const genom::TaskOptions& options = module.tasks()[i].options();
      const std::int64_t tick_ns = 1'000'000'000 / described_module.ticks_per_s;
      EXPECT_EQ(module.tasks()[i].name(), task.name.text);
      EXPECT_EQ(options.period_ms.ns(), task.period_ticks.value_or(0) * tick_ns);
      EXPECT_EQ(options.delay_ms.ns(), task.delay_ticks * tick_ns);
      EXPECT_EQ(module.tasks()[i].has_permanent(), !task.main.empty());
    }
  }
}

TEST_F(ShippedModules, HaveTheDescribedReports) {
  using posters::NavigationReport;
  using rflex::CalibrationReport;
  const std::map<std::string, std::map<std::string, int>> codes = {
      {"ndd",
       {{"BLOCKED", static_cast<int>(NavigationReport::blocked)},
        {"NO_POSITION", static_cast<int>(NavigationReport::no_position)},
        {"NOT_DRIVING", static_cast<int>(NavigationReport::not_driving)}}},
      {"rflex",
       {{"NO_GYRO", static_cast<int>(CalibrationReport::no_gyro)},
        {"MOVED", static_cast<int>(CalibrationReport::moved)}}}};
  for (const std::string& name : module_names) {
    std::map<std::string, int> described_codes;
    int code = genom::first_own_report;
    for (const std::string& report : described(name).reports) described_codes[report] = code++;
    EXPECT_EQ(described_codes, codes.contains(name) ? codes.at(name) : decltype(described_codes){}) << name;
  }
}

TEST(Requests, AreDocumentedFromTheDescriptions) {
  std::string text;
  for (const std::string& name : module_names) text += (text.empty() ? "" : "\n") + documentation(described(name));
  const std::string page = given_file_contents(root() + "/docs/requests.md", 1 << 20);
  EXPECT_EQ(page.substr(page.find("# Module")), text)
      << "for m in ndd pom rflex segloc sick: waitpoint genom --documentation modules/$m/$m.gen";
}

}  // namespace
}  // namespace waitpoint::tools
