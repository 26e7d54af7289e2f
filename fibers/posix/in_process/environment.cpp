// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/in_process/environment.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"

namespace waitpoint::posix {

struct Environment::Text {
  Text* next;
  char text[];
};

namespace {

std::size_t count_of(char** variables) {
  std::size_t count = 0;
  while (variables != nullptr && variables[count] != nullptr) ++count;
  return count;
}

bool is_name(const char* name) { return name != nullptr && *name != '\0' && std::strchr(name, '=') == nullptr; }

}  // namespace

bool Environment::begin(char** from) {
  WAITPOINT_CHECK(own_ == nullptr && texts_ == nullptr, "an environment begins twice");
  variables = from;
  return own(count_of(from));
}

void Environment::forget() {
  while (texts_ != nullptr) {
    Text* const text = texts_;
    texts_ = text->next;
    std::free(text);
  }
  std::free(own_);
  own_ = variables = nullptr;
  room_ = 0;
}

// Moves the variables to the environment's own memory, with room for so many.
bool Environment::own(std::size_t room) {
  const std::size_t count = count_of(variables);
  WAITPOINT_CHECK(count <= room, "an environment has no room for its variables");
  if (variables == own_ && own_ != nullptr && room <= room_) return true;
  auto** const memory = static_cast<char**>(std::malloc((room + 1) * sizeof(char*)));
  if (memory == nullptr) return false;
  for (std::size_t i = 0; i < count; ++i) memory[i] = variables[i];
  memory[count] = nullptr;
  std::free(own_);
  own_ = variables = memory;
  room_ = room;
  return true;
}

char** Environment::place_of(const char* name, std::size_t length) const {
  for (char** each = variables; each != nullptr && *each != nullptr; ++each)
    if (std::strncmp(*each, name, length) == 0 && (*each)[length] == '=') return each;
  return nullptr;
}

bool Environment::place(char* text, std::size_t length) {
  if (char** const known = place_of(text, length); known != nullptr) {
    *known = text;
    return true;
  }
  const std::size_t count = count_of(variables);
  if (!own(variables == own_ && count < room_ ? room_ : 2 * count + 1)) return false;
  variables[count] = text;
  variables[count + 1] = nullptr;
  return true;
}

char* Environment::find(const char* name) const {
  const std::size_t length = std::strlen(name);
  char** const place = length > 0 ? place_of(name, length) : nullptr;
  return place != nullptr ? *place + length + 1 : nullptr;
}

int Environment::set(const char* name, const char* value, bool replace) {
  if (!is_name(name)) return EINVAL;
  const std::size_t length = std::strlen(name);
  if (!replace && place_of(name, length) != nullptr) return 0;
  const std::size_t size = length + 1 + std::strlen(value) + 1;
  auto* const made = static_cast<Text*>(std::malloc(sizeof(Text) + size));
  if (made == nullptr) return ENOMEM;
  std::snprintf(made->text, size, "%s=%s", name, value);
  made->next = texts_;
  texts_ = made;
  return place(made->text, length) ? 0 : ENOMEM;
}

int Environment::put(char* text) {
  const char* const end = std::strchr(text, '=');
  if (end == nullptr) return remove(text);
  return place(text, static_cast<std::size_t>(end - text)) ? 0 : ENOMEM;
}

int Environment::remove(const char* name) {
  if (!is_name(name)) return EINVAL;
  const std::size_t length = std::strlen(name);
  while (char** place = place_of(name, length))
    for (; *place != nullptr; ++place) *place = place[1];
  return 0;
}

void Environment::clear() { variables = nullptr; }

}  // namespace waitpoint::posix
