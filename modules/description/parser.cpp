// SPDX-License-Identifier: BSD-3-Clause
#include "modules/description/parser.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/file_contents.hpp"
#include "core/nearest_name.hpp"
#include "modules/description/c_declarations.hpp"
#include "modules/description/token_stream.hpp"

namespace waitpoint::description {
namespace {

constexpr std::size_t file_bytes_max = std::size_t{4} << 20;

// GenoM's earlier keywords.
constexpr std::pair<std::string_view, std::string_view> earlier_keywords[] = {
    {"c_control_func", "codel_control"},
    {"c_exec_func_start", "codel_start"},
    {"c_exec_func", "codel_main"},
    {"c_exec_func_end", "codel_end"},
    {"c_exec_func_fail", "codel_fail"},
    {"c_exec_func_inter", "codel_inter"},
    {"incompatible_with", "interrupt_activity"},
    {"fail_msg", "fail_reports"},
    {"error_reports", "fail_reports"},
    {"c_init_func", "codel_task_start"},
    {"c_end_func", "codel_task_end"},
    {"c_func", "codel_task_main"},
    {"c_create_func", "codel_poster_create"}};

struct Attribute {
  std::string_view keyword;
  std::function<void()> read;
};
using Attributes = std::vector<Attribute>;

class Parser {
 public:
  Parser(const SourceFile& source, const std::vector<std::string>& include_folders, const ReadFile& read_file)
      : source_(source), preprocessed_(preprocess(source, include_folders, read_file)), tokens_(preprocessed_.tokens) {
    description_.file = source.path;
  }

  Description read() {
    while (!tokens_.at_end()) read_part();
    for (const Directive& directive : preprocessed_.directives) texts_.emplace_back(directive.begin, directive.text);
    std::stable_sort(texts_.begin(), texts_.end(), [](auto& a, auto& b) { return a.first < b.first; });
    for (auto& [begin, text] : texts_) description_.declarations.push_back(std::move(text));
    if (description_.name.text.empty()) tokens_.fail("expected a declaration 'module NAME { ... };'");
    if (!data_.text.empty()) description_.data = types_.find_type(data_.text);
    if (description_.data == nullptr || description_.data->kind != TypeKind::structure)
      reject(data_.place, "expected the typedef of a struct for internal_data" +
                              (data_.text.empty() ? "" : ", found '" + data_.text + "'"));
    return std::move(description_);
  }

 private:
  void read_part() {
    if (tokens_.accept(";")) return;
    if (tokens_.accept("module")) return read_module();
    if (tokens_.accept("import")) return read_import();
    if (tokens_.accept("request")) return read_request();
    if (tokens_.accept("poster")) return read_poster();
    if (tokens_.accept("exec_task")) return read_task();
    read_declaration("expected module, import, request, poster, exec_task or a C declaration");
  }

  void read_declaration(const std::string& expected) {
    const Token first = tokens_.peek();
    if (first.kind != TokenKind::name) tokens_.fail(expected);
    types_.declare(tokens_);
    if (*first.place.file == source_.path && *tokens_.previous().place.file == source_.path)
      texts_.emplace_back(first.begin, source_.contents.substr(first.begin, tokens_.previous().end - first.begin));
  }

  Name read_name(const std::string& what) {
    const Token& token = tokens_.expect_declared_name(what);
    return {token.text, token.place};
  }
  std::string read_text(const std::string& what) {
    if (tokens_.peek().kind != TokenKind::text) tokens_.fail("expected " + what + " in quotes");
    std::string text;
    while (tokens_.peek().kind == TokenKind::text) text += tokens_.take().text;
    return text;
  }
  std::int64_t read_number(std::int64_t least, std::int64_t most, const std::string& what) {
    const SourcePlace place = tokens_.peek().place;
    const std::int64_t number = types_.constant(tokens_);
    if (number < least || number > most)
      reject(place, "expected " + what + " from " + std::to_string(least) + " to " + std::to_string(most) + ", found " +
                        std::to_string(number));
    return number;
  }
  template <class Read>
  void read_list(const Read& read) {
    do read();
    while (tokens_.accept(","));
  }
  std::function<void()> codel(std::string& to) {
    return [this, &to] { to = read_name("the name of a codel").text; };
  }
  std::function<void()> names(std::vector<Name>& to, const char* what) {
    return [this, &to, what] { read_list([&] { to.push_back(read_name(what)); }); };
  }
  std::function<void()> type_names(std::vector<std::string>& to) {
    return [this, &to] { read_list([&] { to.push_back(types_.type_name(tokens_)->name); }); };
  }

  // '{' { KEYWORD ':' value ';' } '}' ';'
  void read_attributes(const std::string& of, const Attributes& attributes) {
    tokens_.expect("{", "behind the name of " + of);
    std::set<std::string_view> read;
    while (!tokens_.accept("}")) {
      const Token token = tokens_.expect_name("an attribute of " + of);
      std::string_view keyword = token.text;
      for (const auto& [earlier, present] : earlier_keywords)
        if (keyword == earlier) keyword = present;
      const auto found = std::find_if(attributes.begin(), attributes.end(),
                                      [&](const Attribute& attribute) { return attribute.keyword == keyword; });
      if (found == attributes.end()) {
        std::vector<std::string_view> known;
        for (const Attribute& attribute : attributes) known.push_back(attribute.keyword);
        reject(token.place,
               "expected an attribute of " + of + ", found '" + token.text + "'" + did_you_mean(keyword, known));
      }
      if (!read.insert(found->keyword).second) reject(token.place, "expected '" + token.text + "' once");
      tokens_.expect(":", "behind '" + token.text + "'");
      found->read();
      tokens_.expect(";", "behind the value of '" + token.text + "'");
    }
  }

  void read_module() {
    const SourcePlace place = tokens_.peek().place;
    if (!description_.name.text.empty()) reject(place, "expected one module in a file");
    description_.name = read_name("the name of a module");
    data_.place = place;
    const auto packages = [this] { read_list([this] { read_package(); }); };
    const auto ignored_text = [this] { read_list([this] { read_text("a text"); }); };
    read_attributes(
        "a module",
        {{"number", [this] { description_.number = read_number(1, 32767, "a module's number"); }},
         {"internal_data",
          [this] {
            tokens_.accept("struct");
            data_ = read_name("the name of the internal data's type");
          }},
         {"version", [this] { description_.version = read_text("a version"); }},
         {"email", [this] { description_.email = read_text("an address"); }},
         {"clock_rate", [this] { description_.ticks_per_s = read_number(1, 1'000'000, "ticks per second"); }},
         {"lang", [this] { read_language(); }},
         {"uses_cxx", [this] { description_.cxx_codels = read_number(0, 1, "a switch") != 0; }},
         {"requires", packages},
         {"codels_requires", packages},
         {"codel_files", ignored_text},
         {"iface_version", [this] {
            do read_number(0, 1'000'000, "a version");
            while (tokens_.accept(":"));
          }}});
    if (description_.number == 0) reject(place, "expected the attribute 'number' of the module");
  }

  void read_language() {
    const SourcePlace place = tokens_.peek().place;
    const std::string language = read_text("a language");
    if (language != "c" && language != "C" && language != "c++" && language != "C++")
      reject(place, "expected the language \"c\" or \"c++\", found '" + language + "'");
    description_.cxx_codels = language.size() > 1;
  }

  // Names of packages have dashes.
  void read_package() {
    std::string name;
    if (tokens_.peek().kind == TokenKind::text) {
      name = read_text("a package");
    } else {
      name = tokens_.expect_name("a package").text;
      while (tokens_.next_is("-") || tokens_.next_is(".") || (tokens_.previous().text == "-" && !tokens_.next_is(";")))
        name += tokens_.take().text;
    }
    description_.packages.push_back(name);
  }

  void read_import() {
    if (tokens_.accept("from")) description_.imports.push_back(read_name("the name of a module").text);
    tokens_.expect("{", "behind 'import from MODULE'");
    while (!tokens_.accept("}"))
      if (!tokens_.accept(";")) read_declaration("expected a C declaration or '}'");
  }

  Parameter read_parameter() {
    Parameter parameter;
    parameter.place = tokens_.peek().place;
    parameter.name = read_name("a name in 'NAME::MEMBER of the internal data'").text;
    tokens_.expect("::", "behind '" + parameter.name + "', as in 'NAME::MEMBER of the internal data'");
    do parameter.path.push_back(read_name("a member of the internal data").text);
    while (tokens_.accept("."));
    return parameter;
  }

  InputInfo read_input_info() {
    InputInfo info;
    info.place = tokens_.peek().place;
    if (tokens_.peek().kind == TokenKind::text) {
      info.is_text = true;
      info.value = read_text("a default value");
    } else {
      const bool negative = tokens_.next_is("-") && tokens_.peek(1).kind == TokenKind::number;
      const Token& number = tokens_.peek(negative ? 1 : 0);
      if (number.kind == TokenKind::number && number.text.find_first_of(".eE") != std::string::npos &&
          !number.text.starts_with("0x")) {
        if (negative) tokens_.take();
        info.value = (negative ? "-" : "") + tokens_.take().text;
      } else {
        info.value = std::to_string(types_.constant(tokens_));
      }
    }
    tokens_.expect("::", "behind a default value");
    info.text = read_text("what the input means");
    return info;
  }

  void read_request() {
    Request request;
    request.name = read_name("the name of a request");
    bool typed = false;
    const auto parameter = [this](std::optional<Parameter>& to) { return [this, &to] { to = read_parameter(); }; };
    read_attributes("a request",
                    {{"type",
                      [&] {
                        typed = true;
                        request.kind = read_kind();
                      }},
                     {"doc", [&] { request.doc = read_text("a comment"); }},
                     {"exec_task", [&] { request.exec_task = read_name("the name of an exec_task"); }},
                     {"input", parameter(request.input)},
                     {"input_info", [&] { read_list([&] { request.input_infos.push_back(read_input_info()); }); }},
                     {"output", parameter(request.output)},
                     {"codel_control", codel(request.control)},
                     {"codel_start", codel(request.start)},
                     {"codel_main", codel(request.main)},
                     {"codel_end", codel(request.end)},
                     {"codel_fail", codel(request.fail)},
                     {"codel_inter", codel(request.inter)},
                     {"fail_reports", names(request.fail_reports, "the name of a report")},
                     {"interrupt_activity", names(request.interrupts, "a request, 'all' or 'none'")},
                     {"posters_input", type_names(request.posters_input)},
                     {"rqst_num", [&] { read_number(0, 1'000'000, "a number"); }},
                     {"resources", names(resources_, "a resource")}});
    if (!typed) reject(request.name.place, "expected the attribute 'type' of '" + request.name.text + "'");
    description_.requests.push_back(std::move(request));
  }

  RequestKind read_kind() {
    for (const RequestKind kind : {RequestKind::control, RequestKind::exec, RequestKind::init})
      if (tokens_.accept(name(kind))) return kind;
    tokens_.fail("expected control, exec or init");
  }

  void read_poster() {
    Poster poster;
    poster.name = read_name("the name of a poster");
    read_attributes("a poster", {{"update",
                                  [&] {
                                    poster.automatic = tokens_.accept("auto");
                                    if (!poster.automatic) tokens_.expect("user", "or 'auto'");
                                  }},
                                 {"data", [&] { read_list([&] { poster.data.push_back(read_parameter()); }); }},
                                 {"type", [&] { read_list([&] { poster.data.push_back(read_typed()); }); }},
                                 {"exec_task", [&] { poster.exec_task = read_name("the name of an exec_task"); }}});
    description_.posters.push_back(std::move(poster));
  }

  // NAME '::' TYPE
  Parameter read_typed() {
    Parameter parameter;
    parameter.place = tokens_.peek().place;
    parameter.name = read_name("a name in 'NAME::TYPE'").text;
    tokens_.expect("::", "behind '" + parameter.name + "', as in 'NAME::TYPE'");
    parameter.type = types_.type_name(tokens_);
    return parameter;
  }

  void read_task() {
    ExecTask task;
    task.name = read_name("the name of an exec_task");
    constexpr std::int64_t ticks_max = 1'000'000'000;
    const auto ticks = [this] { return read_number(0, ticks_max, "a number of ticks"); };
    read_attributes("an exec_task",
                    {{"period",
                      [&] {
                        if (!tokens_.accept("none")) task.period_ticks = read_number(1, ticks_max, "a number of ticks");
                      }},
                     {"delay",
                      [&] {
                        if (!tokens_.accept("none")) task.delay_ticks = ticks();
                      }},
                     {"priority", [&] { task.priority = read_number(0, 255, "a priority"); }},
                     {"stack_size", [&] { task.stack_size = read_number(0, 1 << 30, "a number of bytes"); }},
                     {"codel_task_start", codel(task.start)},
                     {"codel_task_main", codel(task.main)},
                     {"codel_task_main2", codel(task.main2)},
                     {"codel_task_end", codel(task.end)},
                     {"codel_task_wait", codel(task.wait)},
                     {"fail_reports", names(task.fail_reports, "the name of a report")},
                     {"posters_input", type_names(task.posters_input)},
                     {"cs_client_from",
                      [&] { read_list([&] { task.clients_from.push_back(read_name("the name of a module").text); }); }},
                     {"poster_client_from", [&] { read_list([&] { task.reads.push_back(read_foreign_poster()); }); }},
                     {"resources", names(resources_, "a resource")}});
    description_.tasks.push_back(std::move(task));
  }

  // MODULE '::' POSTER
  std::string read_foreign_poster() {
    const std::string module = read_name("the name of a module").text;
    tokens_.expect("::", "behind '" + module + "', as in 'MODULE::POSTER'");
    return module + "." + read_name("the name of a poster").text;
  }

  const SourceFile& source_;
  Preprocessed preprocessed_;
  TokenStream tokens_;
  CDeclarations types_;
  Description description_;
  Name data_;
  std::vector<Name> resources_;  // of VxWorks: without meaning here
  std::vector<std::pair<std::size_t, std::string>> texts_;
};

}  // namespace

Description parse(const SourceFile& source, const std::vector<std::string>& include_folders,
                  const ReadFile& read_file) {
  return Parser(source, include_folders, read_file).read();
}

Description parse_description(const SourceFile& source, const std::vector<std::string>& include_folders,
                              const ReadFile& read_file) {
  Description description = parse(source, include_folders, read_file);
  resolve(description);
  return description;
}

Description read_description(const std::string& path, const std::vector<std::string>& include_folders) {
  const ReadFile read_file = [](const std::string& included) -> std::optional<std::string> {
    std::error_code error;
    if (!std::filesystem::is_regular_file(included, error)) return std::nullopt;
    return given_file_contents(included, file_bytes_max);
  };
  return parse_description({path, given_file_contents(path, file_bytes_max)}, include_folders, read_file);
}

}  // namespace waitpoint::description
