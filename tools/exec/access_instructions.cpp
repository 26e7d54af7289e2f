// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/access_instructions.hpp"

#include <Zydis/Zydis.h>
#include <elf.h>
#include <ucontext.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace waitpoint::tools {
namespace {

using posix::AccessInstruction;

// A part of the file's code.
struct Piece {
  std::uint64_t begin, end;  // addresses as linked
};

class Code {
 public:
  explicit Code(std::string bytes) : bytes_(std::move(bytes)) {
    Elf64_Ehdr head;
    if (!get(head, 0) || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_machine != EM_X86_64) return;
    for (std::uint64_t i = 0; i < head.e_shnum; ++i)
      if (Elf64_Shdr section; get(section, head.e_shoff + i * sizeof section)) sections_.push_back(section);
    if (head.e_shstrndx >= sections_.size()) return;
    for (const Elf64_Shdr& section : sections_)
      if (text_at(sections_[head.e_shstrndx], section.sh_name) == ".text") text_ = section;
  }

  /// The functions, or else the whole.
  std::vector<Piece> pieces() const {
    if (text_.sh_size == 0) return {};
    std::vector<Piece> functions;
    for (const Elf64_Shdr& section : sections_)
      if (section.sh_type == SHT_SYMTAB) add_functions(section, functions);
    if (functions.empty()) functions.push_back({text_.sh_addr, text_.sh_addr + text_.sh_size});
    return functions;
  }

  std::span<const char> bytes(const Piece& piece) const {
    const std::uint64_t from = text_.sh_offset + (piece.begin - text_.sh_addr), size = piece.end - piece.begin;
    if (from > bytes_.size() || size > bytes_.size() - from) return {};
    return std::span(bytes_).subspan(from, size);
  }

 private:
  template <class T>
  bool get(T& to, std::uint64_t from) const {
    if (from > bytes_.size() || sizeof to > bytes_.size() - from) return false;
    std::memcpy(&to, bytes_.data() + from, sizeof to);
    return true;
  }

  std::string_view text_at(const Elf64_Shdr& names, std::uint64_t at) const {
    const std::uint64_t from = names.sh_offset + at;
    if (from >= bytes_.size()) return {};
    const std::string_view rest = std::string_view(bytes_).substr(from);
    return rest.substr(0, rest.find('\0'));
  }

  void add_functions(const Elf64_Shdr& symbols, std::vector<Piece>& functions) const {
    for (std::uint64_t i = 0; i < symbols.sh_size / sizeof(Elf64_Sym); ++i) {
      Elf64_Sym symbol;
      if (!get(symbol, symbols.sh_offset + i * sizeof symbol)) return;
      const bool is_inside = symbol.st_value >= text_.sh_addr && symbol.st_size <= text_.sh_size &&
                             symbol.st_value - text_.sh_addr <= text_.sh_size - symbol.st_size;
      if (ELF64_ST_TYPE(symbol.st_info) == STT_FUNC && symbol.st_size > 0 && is_inside)
        functions.push_back({symbol.st_value, symbol.st_value + symbol.st_size});
    }
  }

  std::string bytes_;
  std::vector<Elf64_Shdr> sections_;
  Elf64_Shdr text_{};
};

// Its number in ucontext_t's gregs.
std::optional<std::uint8_t> saved_place(ZydisRegister found) {
  switch (found) {
    case ZYDIS_REGISTER_NONE:
    case ZYDIS_REGISTER_RIP: return AccessInstruction::none;
    case ZYDIS_REGISTER_RAX: return REG_RAX;
    case ZYDIS_REGISTER_RBX: return REG_RBX;
    case ZYDIS_REGISTER_RCX: return REG_RCX;
    case ZYDIS_REGISTER_RDX: return REG_RDX;
    case ZYDIS_REGISTER_RSI: return REG_RSI;
    case ZYDIS_REGISTER_RDI: return REG_RDI;
    case ZYDIS_REGISTER_RBP: return REG_RBP;
    case ZYDIS_REGISTER_RSP: return REG_RSP;
    case ZYDIS_REGISTER_R8: return REG_R8;
    case ZYDIS_REGISTER_R9: return REG_R9;
    case ZYDIS_REGISTER_R10: return REG_R10;
    case ZYDIS_REGISTER_R11: return REG_R11;
    case ZYDIS_REGISTER_R12: return REG_R12;
    case ZYDIS_REGISTER_R13: return REG_R13;
    case ZYDIS_REGISTER_R14: return REG_R14;
    case ZYDIS_REGISTER_R15: return REG_R15;
    default: return std::nullopt;  // of 32 bits, or of a vector
  }
}

// Padding and hints have operands in memory, which they do not access.
bool accesses_nothing(const ZydisDecodedInstruction& instruction) {
  switch (instruction.meta.category) {
    case ZYDIS_CATEGORY_NOP:
    case ZYDIS_CATEGORY_WIDENOP:
    case ZYDIS_CATEGORY_PREFETCH:
    case ZYDIS_CATEGORY_PREFETCHWT1:
    case ZYDIS_CATEGORY_CLDEMOTE:
    case ZYDIS_CATEGORY_CLFLUSHOPT:
    case ZYDIS_CATEGORY_CLWB: return true;
    default: return false;
  }
}

bool is_repeated(const ZydisDecodedInstruction& instruction) {
  return (instruction.attributes & (ZYDIS_ATTRIB_HAS_REP | ZYDIS_ATTRIB_HAS_REPE | ZYDIS_ATTRIB_HAS_REPNE)) != 0;
}

// Without what executes it and where: a copy of it is executed elsewhere.
AccessInstruction coded(const ZydisDecodedInstruction& instruction, std::uint64_t address, const char* code) {
  AccessInstruction access{};
  access.place = address;
  access.base = access.index = access.bit = AccessInstruction::none;
  access.length = instruction.length;
  std::memcpy(access.code, code, instruction.length);
  return access;
}

// Those that fill and copy memory.
std::optional<AccessInstruction> string_access_of(const ZydisDecodedInstruction& instruction,
                                                  const ZydisDecodedOperand& target, AccessInstruction access) {
  const std::string_view name = ZydisMnemonicGetString(instruction.mnemonic);
  if (instruction.address_width != 64 || (!name.starts_with("stos") && !name.starts_with("movs"))) return std::nullopt;
  access.base = REG_RDI;
  access.bytes = static_cast<std::uint8_t>(target.size / 8);
  access.writes = true;
  access.is_repeated = is_repeated(instruction);
  access.copies = name.starts_with("movs");
  return access;
}

bool names_bit(const ZydisDecodedInstruction& instruction) {
  return instruction.mnemonic == ZYDIS_MNEMONIC_BT || instruction.mnemonic == ZYDIS_MNEMONIC_BTS ||
         instruction.mnemonic == ZYDIS_MNEMONIC_BTR || instruction.mnemonic == ZYDIS_MNEMONIC_BTC;
}

// The whole register, of which the operand may be a part.
ZydisRegister whole(ZydisRegister part) { return ZydisRegisterGetLargestEnclosing(ZYDIS_MACHINE_MODE_LONG_64, part); }

std::optional<AccessInstruction> access_of(const ZydisDecodedInstruction& instruction,
                                           std::span<const ZydisDecodedOperand> operands, std::uint64_t address,
                                           const char* code) {
  AccessInstruction access = coded(instruction, address, code);
  if (instruction.meta.category == ZYDIS_CATEGORY_STRINGOP)
    return string_access_of(instruction, operands.front(), access);
  if (accesses_nothing(instruction)) return std::nullopt;
  // Calls and jumps: their copies would push and compute other addresses.
  if (is_repeated(instruction) || instruction.meta.category == ZYDIS_CATEGORY_CALL ||
      instruction.meta.category == ZYDIS_CATEGORY_UNCOND_BR)
    return std::nullopt;
  for (const ZydisDecodedOperand& operand : operands.first(instruction.operand_count_visible)) {
    if (operand.type != ZYDIS_OPERAND_TYPE_MEMORY || operand.mem.type != ZYDIS_MEMOP_TYPE_MEM) continue;
    if (operand.mem.segment == ZYDIS_REGISTER_FS || operand.mem.segment == ZYDIS_REGISTER_GS) continue;
    const bool writes = (operand.actions & ZYDIS_OPERAND_ACTION_MASK_WRITE) != 0;
    const bool reads = (operand.actions & ZYDIS_OPERAND_ACTION_MASK_READ) != 0;
    const unsigned bytes = operand.size / 8;
    const auto base = saved_place(operand.mem.base), index = saved_place(operand.mem.index);
    if ((!writes && !reads) || bytes == 0 || bytes > 64 || !base || !index) continue;
    const std::int64_t next = static_cast<std::int64_t>(address + instruction.length);
    access.is_absolute = operand.mem.base == ZYDIS_REGISTER_RIP;
    access.displacement = (access.is_absolute ? next : 0) + operand.mem.disp.value;
    access.displacement_at = instruction.raw.disp.offset;
    access.base = *base;
    access.index = *index;
    access.scale = operand.mem.scale;
    access.bytes = static_cast<std::uint8_t>(bytes);
    access.reads = reads;
    access.writes = writes;
    access.is_locked =
        instruction.mnemonic == ZYDIS_MNEMONIC_XCHG || (instruction.attributes & ZYDIS_ATTRIB_HAS_LOCK) != 0;
    if (names_bit(instruction) && operands[1].type == ZYDIS_OPERAND_TYPE_REGISTER)
      access.bit = saved_place(whole(operands[1].reg.value)).value_or(AccessInstruction::none);
    return access;
  }
  return std::nullopt;
}

void add_accesses(const ZydisDecoder& decoder, const Piece& piece, std::span<const char> bytes,
                  std::vector<AccessInstruction>& found) {
  ZydisDecodedInstruction instruction;
  ZydisDecodedOperand operands[ZYDIS_MAX_OPERAND_COUNT];
  for (std::uint64_t at = 0; at < bytes.size(); at += instruction.length) {
    if (!ZYAN_SUCCESS(ZydisDecoderDecodeFull(&decoder, bytes.data() + at, bytes.size() - at, &instruction, operands)))
      return;
    if (const auto access = access_of(instruction, operands, piece.begin + at, bytes.data() + at))
      found.push_back(*access);
  }
}

}  // namespace

bool has_disassembler() { return true; }

std::vector<AccessInstruction> access_instructions(const std::filesystem::path& file, std::size_t module) {
  std::ifstream bytes(file, std::ios::binary);
  const Code code(std::string(std::istreambuf_iterator<char>(bytes), {}));
  ZydisDecoder decoder;
  ZydisDecoderInit(&decoder, ZYDIS_MACHINE_MODE_LONG_64, ZYDIS_STACK_WIDTH_64);
  std::vector<AccessInstruction> found;
  for (const Piece& piece : code.pieces()) add_accesses(decoder, piece, code.bytes(piece), found);
  std::ranges::sort(found, {}, &AccessInstruction::place);
  const auto is_same = [](const AccessInstruction& a, const AccessInstruction& b) { return a.place == b.place; };
  found.erase(std::unique(found.begin(), found.end(), is_same), found.end());
  for (AccessInstruction& one : found) one.place |= std::uint64_t{module} << AccessInstruction::module_shift;
  return found;
}

}  // namespace waitpoint::tools
