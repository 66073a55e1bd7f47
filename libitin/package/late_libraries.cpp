// Some libraries are loaded when they are first called, as most runs need few of them or none. GDAL brings some 130
// more, whose symbols take the dynamic linker 40 ms: several times what a profile takes. Embree casts the rays of few
// commands, Cairo draws charts; each takes 1 MB and more. A program with this source in it starts without them. Each of
// their functions that it calls is defined here as a jump. The jump leads to a loader at first, and from then on to the
// library's own function. This works for x86-64 and ELF alone.
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>

// The build (late_calls.sh) writes late.calls: a line LATE_LIBRARY(name) for each library, in order, and a line
// LATE_CALL(library, name) for each function.
#define LATE_CALL(library, name)
#define LATE_LIBRARY(name) name,
namespace {
constexpr std::array kLibraries{
#include "late.calls"
};
}  // namespace
#undef LATE_CALL
#undef LATE_LIBRARY

// clang-format off
#define LATE_LIBRARY(name)
#define LATE_CALL(library, name)          \
  asm(".text\n"                           \
      ".globl " #name "\n"                \
      ".type " #name ", @function\n"      \
      #name ":\n"                         \
      "  jmpq *1f(%rip)\n"                \
      "2: leaq 1f(%rip), %r11\n"          \
      "  jmp itin_late_call\n"            \
      ".size " #name ", . - " #name "\n"  \
      ".section .rodata\n"                \
      "3: .asciz \"" #name "\"\n"         \
      ".data\n"                           \
      ".balign 8\n"                       \
      "1: .quad 2b\n"                     \
      "  .quad 3b\n"                      \
      "  .quad " #library "\n"            \
      ".text\n");
// clang-format on
#include "late.calls"

namespace {

/// The target of a jump, and the function and library that it stands for, as LATE_CALL lays them out.
struct LateCall {
  void* target;
  const char* function;
  std::uint64_t library;
};

[[noreturn]] void end_without(const char* library) {
  std::fprintf(stderr, "itin: %s cannot be loaded: %s\n", library, dlerror());
  std::_Exit(EXIT_FAILURE);
}

/// Returns the library's handle. Threads that come here at once get the same one.
void* loaded(std::uint64_t library) {
  static std::array<std::atomic<void*>, kLibraries.size()> all{};
  void* handle = all[library].load(std::memory_order_acquire);
  if (handle != nullptr) return handle;
  handle = dlopen(kLibraries[library], RTLD_LAZY | RTLD_GLOBAL);
  if (handle == nullptr) end_without(kLibraries[library]);
  all[library].store(handle, std::memory_order_release);
  return handle;
}

}  // namespace

/// Makes the jump lead to the library's function from now on. Threads that come here at once store the same address.
extern "C" void itin_resolve_late_call(LateCall* call) {
  void* const target = dlsym(loaded(call->library), call->function);
  if (target == nullptr) end_without(kLibraries[call->library]);
  std::atomic_ref(call->target).store(target, std::memory_order_release);
}

// The loader. A jump comes here with its LateCall in r11, a register that passes no arguments. All registers that may
// pass arguments are kept; the stack is aligned as calls want it.
asm(R"(
  .text
  .type itin_late_call, @function
itin_late_call:
  .cfi_startproc
  pushq %rbp
  .cfi_adjust_cfa_offset 8
  .cfi_rel_offset rbp, 0
  movq %rsp, %rbp
  .cfi_def_cfa_register rbp
  pushq %rax
  pushq %rdi
  pushq %rsi
  pushq %rdx
  pushq %rcx
  pushq %r8
  pushq %r9
  pushq %r11
  subq $128, %rsp
  movups %xmm0, (%rsp)
  movups %xmm1, 16(%rsp)
  movups %xmm2, 32(%rsp)
  movups %xmm3, 48(%rsp)
  movups %xmm4, 64(%rsp)
  movups %xmm5, 80(%rsp)
  movups %xmm6, 96(%rsp)
  movups %xmm7, 112(%rsp)
  movq %r11, %rdi
  call itin_resolve_late_call
  movups (%rsp), %xmm0
  movups 16(%rsp), %xmm1
  movups 32(%rsp), %xmm2
  movups 48(%rsp), %xmm3
  movups 64(%rsp), %xmm4
  movups 80(%rsp), %xmm5
  movups 96(%rsp), %xmm6
  movups 112(%rsp), %xmm7
  addq $128, %rsp
  popq %r11
  popq %r9
  popq %r8
  popq %rcx
  popq %rdx
  popq %rsi
  popq %rdi
  popq %rax
  popq %rbp
  .cfi_def_cfa rsp, 8
  jmpq *(%r11)
  .cfi_endproc
  .size itin_late_call, . - itin_late_call
)");
