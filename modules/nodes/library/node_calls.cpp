// SPDX-License-Identifier: BSD-3-Clause
// Loaded into each node before roscpp, in place of two of its functions: the layer that simulates it knows from then on
// for which service its threads wait.
#include <dlfcn.h>
#include <ros/service.h>
#include <ros/service_client.h>

#include <string>

#include "core/lasting_wait.hpp"

namespace {

template <class Function>
Function* find(void* where, const char* name) {
  return reinterpret_cast<Function*>(dlsym(where, name));
}

/// Scope of a wait that is told.
class ToldWait {
 public:
  explicit ToldWait(const std::string& what) {
    if (auto* const begin = find<waitpoint::BeginWait>(RTLD_DEFAULT, waitpoint::begin_wait); begin != nullptr)
      wait_ = begin(what.c_str());
  }
  ~ToldWait() {
    if (auto* const end = find<waitpoint::EndWait>(RTLD_DEFAULT, waitpoint::end_wait); end != nullptr) end(wait_);
  }
  ToldWait(const ToldWait&) = delete;
  ToldWait& operator=(const ToldWait&) = delete;

 private:
  int wait_ = -1;
};

}  // namespace

namespace ros {

bool ServiceClient::call(const SerializedMessage& request, SerializedMessage& response, const std::string& type) {
  // As a member function is called.
  using Call = bool(ServiceClient*, const SerializedMessage&, SerializedMessage&, const std::string&);
  static auto* const next = find<Call>(RTLD_NEXT,
                                       "_ZN3ros13ServiceClient4callERKNS_17SerializedMessageERS1_RKNSt7__cxx1112basic_"
                                       "stringIcSt11char_traitsIcESaIcEEE");
  const ToldWait wait("the service " + getService());
  return next(this, request, response, type);
}

namespace service {

bool waitForService(const std::string& name, ros::Duration timeout) {
  static auto* const next = find<bool(const std::string&, ros::Duration)>(
      RTLD_NEXT, "_ZN3ros7service14waitForServiceERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEENS_8DurationE");
  const ToldWait wait("somebody to offer the service " + name);
  return next(name, timeout);
}

}  // namespace service
}  // namespace ros
