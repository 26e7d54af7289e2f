// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output/json_document.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

std::string json_document(const std::string& command, std::optional<int> status, const std::string& result) {
  using Json = nlohmann::ordered_json;
  Json document{{"format", 1}, {"command", command}};
  document["status"] = status ? Json(*status) : Json();
  document["result"] = Json::parse(result);
  return document.dump(2) + "\n";
}

int end_with_json(const std::string& command, int status, const std::string& result) {
  write_standard_output(json_document(command, status, result));
  return status;
}

void write_text(std::string_view text, bool is_json) {
  if (!is_json) return write_standard_output(text);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace waitpoint::tools
