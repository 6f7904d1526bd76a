/* A Cortex-M core from reset on: runs each job, counts its instructions by SysTick, and how deep its stack goes. Prints
   by semihosting: Arm, Semihosting for AArch32 and AArch64, operations SYS_WRITE0 and SYS_EXIT. */
#include "board.h"

#include <stdint.h>

#define SYST_CSR (*(volatile uint32_t *)0xE000E010) /* Armv7-M Architecture Reference Manual, B3.3.2 */
#define SYST_RVR (*(volatile uint32_t *)0xE000E014)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018)
#define CPACR (*(volatile uint32_t *)0xE000ED88) /* ibid., B3.2.20: who may use the FPU */
#define LARGEST 0xFFFFFFu

#define WRITE0 0x04
#define EXIT 0x18
#define STOPPED ((const void *)0x20026)
#define FAILED ((const void *)0x20023)

#define LONGEST 100000u /* ticks, for all repetitions of a job */
#define MOST 400u       /* repetitions */
#define UNUSED 0xDEADBEEFu

static uint32_t stack[65536];

static void __attribute__((noinline)) call_host(int operation, const void *argument)
{
    register int r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

static char text[4096];
static unsigned length;

static void flush(void)
{
    text[length] = 0;
    call_host(WRITE0, text);
    length = 0;
}

static void put(const char *part)
{
    while (*part) {
        if (length == sizeof text - 1)
            flush();
        text[length++] = *part++;
    }
}

static void put_number(uint32_t value)
{
    char digits[11];
    unsigned at = sizeof digits - 1;
    digits[at] = 0;
    do {
        digits[--at] = (char)('0' + value % 10);
        value /= 10;
    } while (value);
    put(" ");
    put(digits + at);
}

static void put_bytes(const Shown *shown)
{
    const unsigned char *bytes = shown->memory;
    char digits[3] = {0};
    put("SHOWN ");
    for (size_t i = 0; i < shown->size; i++) {
        digits[0] = "0123456789abcdef"[bytes[i] >> 4];
        digits[1] = "0123456789abcdef"[bytes[i] & 15];
        put(digits);
    }
    put("\n");
}

void fault(const char *message)
{
    put("FAULT ");
    put(message);
    put("\n");
    flush();
    call_host(EXIT, FAILED);
    for (;;) {
    }
}

static uint32_t __attribute__((noinline)) ticks(void (*run)(void), uint32_t repetitions)
{
    SYST_RVR = LARGEST;
    SYST_CVR = 0;
    SYST_CSR = 5; /* on, by the clock of the core, without interrupts */
    const uint32_t start = SYST_CVR;
    for (uint32_t i = 0; i < repetitions; i++)
        run();
    return (start - SYST_CVR) & LARGEST;
}

static void __attribute__((naked, noinline)) run_on(uint32_t *top, void (*run)(void))
{
    (void)top, (void)run;
    __asm__ volatile("push {r4, lr}\n mov r4, sp\n mov sp, r0\n blx r1\n mov sp, r4\n pop {r4, pc}");
}

static uint32_t stack_of(void (*run)(void))
{
    const uint32_t size = sizeof stack / sizeof stack[0];
    for (uint32_t i = 0; i < size; i++)
        stack[i] = UNUSED;
    run_on(stack + size, run);
    uint32_t untouched = 0;
    while (untouched < size && stack[untouched] == UNUSED)
        untouched++;
    if (untouched == 0)
        fault("the stack is too small");
    return (size - untouched) * sizeof stack[0];
}

static void __attribute__((naked, noinline)) nothing(void)
{
    __asm__ volatile("bx lr");
}

static void measure(const Job *job)
{
    job->run();
    for (int i = 0; i < job->shown_count; i++)
        put_bytes(&job->shown[i]);
    const uint32_t once = ticks(job->run, 1) + 1;
    const uint32_t wanted = LONGEST / once, repetitions = wanted < 1 ? 1 : wanted > MOST ? MOST : wanted;
    const uint32_t all = ticks(job->run, repetitions), none = ticks(nothing, repetitions);
    put("COUNT");
    put_number(repetitions);
    put_number(all);
    put_number(none);
    put_number(stack_of(job->run));
    put("\n");
}

void reset(void);
extern uint32_t data_start[], data_end[], data_kept[], bss_start[], bss_end[], stack_top[];

void __attribute__((noreturn)) reset(void)
{
    CPACR |= 0xFu << 20;
    __asm__ volatile("dsb\n isb");
    for (uint32_t *to = data_start, *from = data_kept; to < data_end;)
        *to++ = *from++;
    for (uint32_t *to = bss_start; to < bss_end;)
        *to++ = 0;
    for (int i = 0; i < job_count; i++)
        measure(&jobs[i]);
    put("DONE\n");
    flush();
    call_host(EXIT, STOPPED);
    for (;;) {
    }
}

static void trapped(void)
{
    fault("the core trapped: an access or an instruction that it does not have");
}

__attribute__((section(".vectors"), used)) static void *const vectors[] = {
    stack_top, (void *)reset, (void *)trapped, (void *)trapped, (void *)trapped, (void *)trapped, (void *)trapped,
};
