#include "avr_core.h"

#include "../firmware/atmega128/pins.h"
#include "atmega128.h"
#include "flash_map.h"
#include "limits.h"
#include "own_flash.h"

#include <avr_adc.h>
#include <avr_eeprom.h>
#include <avr_extint.h>
#include <avr_uart.h>
#include <avr_watchdog.h>
#include <sim_avr.h>
#include <sim_regbit.h>
#include <stdlib.h>
#include <string.h>

#define STACK_PAINT 0xC5 /* firmware/atmega128/stack.c */

/* Between two looks at its timers simavr may run this long: same results, twice the speed. */
#define BURST_CYCLES 1000

/* Two bytes of buffer and the shift register. */
#define RECEIVER_DEPTH 3

struct write_hook {
    avr_io_write_t call;
    void *param;
};

struct avr_core {
    avr_t *avr;
    const struct avr_image *image;
    struct own_flash *flash; /* NULL: the image's */
    avr_uart_t *uart;
    avr_io_t last_reset; /* an I/O module of our own, the last one to be reset */
    struct write_hook ubrr, ucsrb, tccr1b;
    avr_cycle_count_t until;
    uint64_t asleep;
    uint64_t timer_start;
    unsigned resets;
    bool faulted;
    bool sp_half_written;
    uint16_t sp_least; /* SRAM_END while nobody watches */

    /* On their way to the receiver, and inside it. */
    const uint8_t *arriving;
    size_t arriving_count, arrived;
    avr_cycle_count_t arriving_start;
    uint8_t held[RECEIVER_DEPTH];
    uint8_t held_count;

    size_t sent_count;
    uint8_t sent[ROBOT_TX_MAX];

    void (*heard)(void *listener, uint8_t byte, uint64_t cycle);
    void *listener;
};

static struct avr_core *core_of(const avr_t *avr)
{
    return avr->custom.data;
}

/* simavr's log says where it met what a chip cannot do; nothing is printed. */
static void note_fault(avr_t *avr, const int level, const char *format, va_list arguments)
{
    (void)format, (void)arguments;
    if (avr != NULL && core_of(avr) != NULL && level == LOG_ERROR)
        core_of(avr)->faulted = true;
}

/* simavr adds the cycles itself; its own callback sleeps in real time. */
static void sleep_through(avr_t *avr, avr_cycle_count_t cycles)
{
    core_of(avr)->asleep += cycles + 1;
}

/* Bytes between the variables and SP, which points to the byte that is pushed next. */
static int above_variables(const struct avr_core *core, uint16_t sp)
{
    return sp + 1 - core->image->data_end;
}

/* The receiver. simavr's takes 11 bit times for a byte and holds 63 of them: this one has a byte
 * when its stop bit is due, and loses the fourth that nobody fetches. */

static avr_cycle_count_t arrival(const struct avr_core *core)
{
    const struct avr_image *image = core->image;
    uint64_t bits = ((uint64_t)core->arrived + 1) * 10;

    return core->arriving_start + (bits * image->f_cpu + image->baud / 2) / image->baud;
}

static void hold(struct avr_core *core, uint8_t byte)
{
    uint8_t *data = core->avr->data;

    if (!(data[UCSR0B] & UCSRB_RXEN))
        return;
    if (core->held_count == RECEIVER_DEPTH) {
        data[UCSR0A] |= UCSRA_DOR;
        return;
    }
    core->held[core->held_count++] = byte;
    avr_raise_interrupt(core->avr, &core->uart->rxc);
}

static avr_cycle_count_t byte_arrives(avr_t *avr, avr_cycle_count_t when, void *param)
{
    struct avr_core *core = param;

    (void)avr, (void)when;
    hold(core, core->arriving[core->arrived++]);
    return core->arrived < core->arriving_count ? arrival(core) : 0;
}

static uint8_t read_udr(avr_t *avr, avr_io_addr_t address, void *param)
{
    struct avr_core *core = param;
    uint8_t byte = core->held[0];

    (void)address;
    avr->data[UCSR0A] &= (uint8_t)~UCSRA_DOR;
    if (core->held_count > 0)
        memmove(core->held, core->held + 1, --core->held_count);
    if (core->held_count > 0) {
        avr_raise_interrupt(avr, &core->uart->rxc);
    } else {
        avr_clear_interrupt(avr, &core->uart->rxc);
        avr_regbit_clear(avr, core->uart->rxc.raised);
    }
    return byte;
}

static void byte_sent(struct avr_irq_t *irq, uint32_t value, void *param)
{
    struct avr_core *core = param;

    (void)irq;
    if (core->sent_count < sizeof core->sent)
        core->sent[core->sent_count++] = (uint8_t)value;
}

/* simavr counts a parity bit that 8N1 does not have. */
static void write_ubrr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    struct avr_core *core = param;

    core->ubrr.call(avr, address, value, core->ubrr.param);
    core->uart->cycles_per_byte = core->uart->cycles_per_byte * 10 / 11;
}

/* A receiver that is switched off forgets what it held, and a transmitter goes on saying that it
 * has room: simavr's says no more until it is reset. */
static void write_ucsrb(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    struct avr_core *core = param;

    core->ucsrb.call(avr, address, value, core->ucsrb.param);
    if (!(value & UCSRB_TXEN))
        avr_regbit_set(avr, core->uart->udrc.raised);
    if (value & UCSRB_RXEN)
        return;
    core->held_count = 0;
    avr_clear_interrupt(avr, &core->uart->rxc);
    avr_regbit_clear(avr, core->uart->rxc.raised);
}

static void write_tccr1b(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    struct avr_core *core = param;

    core->tccr1b.call(avr, address, value, core->tccr1b.param);
    if (value & TCCRB_CLOCK)
        core->timer_start = avr->cycle;
}

/* A program sets SPH before SPL; simavr, as it pushes and pops, SPL before SPH. Nobody sets one of
 * them alone, so after every second write they belong together. */
static void write_sp(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    struct avr_core *core = param;

    avr->data[address] = value;
    core->sp_half_written = !core->sp_half_written;
    if (core->sp_half_written)
        return;
    uint16_t sp = (uint16_t)(avr->data[SPL] | avr->data[SPH] << 8);
    if (sp < core->sp_least) {
        core->sp_least = sp;
        core->faulted |= above_variables(core, sp) < 0;
    }
}

static void write_nothing(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    (void)avr, (void)address, (void)value, (void)param;
}

static void on_write(struct avr_core *core, uint16_t address, avr_io_write_t call,
                     struct write_hook *before)
{
    avr_io_addr_t io = AVR_DATA_TO_IO(address);

    if (before != NULL)
        *before = (struct write_hook){core->avr->io[io].w.c, core->avr->io[io].w.param};
    core->avr->io[io].w.c = call;
    core->avr->io[io].w.param = core;
}

static void hook_registers(struct avr_core *core)
{
    avr_io_addr_t udr = AVR_DATA_TO_IO(UDR0);

    core->avr->io[udr].r.c = read_udr;
    core->avr->io[udr].r.param = core;
    on_write(core, UBRR0L, write_ubrr, &core->ubrr);
    on_write(core, UCSR0B, write_ucsrb, &core->ucsrb);
    on_write(core, TCCR1B, write_tccr1b, &core->tccr1b);
    /* A flash that is shared: no program may write to it. */
    if (core->flash == NULL)
        on_write(core, SPMCSR, write_nothing, NULL);
    /* Nobody looks at the PWM pins: timer 3 keeps its registers and costs no time. */
    for (uint16_t address = ICR3L; address <= TCCR3A; address++)
        on_write(core, address, NULL, NULL);
}

static avr_cycle_count_t stop(avr_t *avr, avr_cycle_count_t when, void *param)
{
    (void)avr, (void)when, (void)param;
    return 0;
}

static void at_cycle(struct avr_core *core, avr_cycle_count_t cycle, avr_cycle_timer_t call)
{
    avr_cycle_count_t now = core->avr->cycle;

    avr_cycle_timer_register(core->avr, cycle > now ? cycle - now : 0, call, core);
}

/* Neither a sleep nor a burst may run beyond `until`. */
static void arm_timers(struct avr_core *core)
{
    at_cycle(core, core->until, stop);
    if (core->arrived < core->arriving_count)
        at_cycle(core, arrival(core), byte_arrives);
}

/* What a reset sets back and should not. */
static void after_reset(avr_io_t *io)
{
    avr_t *avr = io->avr;
    struct avr_core *core = core_of(avr);

    avr->run_cycle_limit = BURST_CYCLES;
    /* Else every external interrupt whose pin is low is polled on every cycle. */
    for (uint8_t i = 0; i < EXTINT_COUNT; i++)
        avr_extint_set_strict_lvl_trig(avr, i, 0);
    /* simavr enables the transmitter by itself, which would hide that the program does not. */
    avr->data[UCSR0B] &= (uint8_t)~UCSRB_TXEN;
    /* As later chips do, simavr goes on with the watchdog after a reset by it. */
    avr->data[WDTCR] = 0;
    core->sp_half_written = false;
    core->held_count = 0;
    core->resets++;
    arm_timers(core);
}

/* The module that serves a register. */
static void *module_of(const avr_t *avr, uint16_t address)
{
    return avr->io[AVR_DATA_TO_IO(address)].w.param;
}

/* Modules are reset from the head of the list on, and registered there. */
static void append_io(struct avr_core *core)
{
    avr_io_t *tail = core->avr->io_port;

    while (tail->next != NULL)
        tail = tail->next;
    tail->next = &core->last_reset;
    core->last_reset = (avr_io_t){.avr = core->avr, .kind = "muster", .reset = after_reset};
}

/* What RAM holds at power-on is not defined: here it is never 0 by luck. */
static void fill_ram(uint8_t *data)
{
    uint32_t state = 1;

    for (unsigned i = 0; i <= SRAM_END; i++) {
        state = state * 1664525u + 1013904223u;
        if (i < 32 || i >= SRAM_START)
            data[i] = (uint8_t)(state >> 24);
    }
}

static void take_flash(struct avr_core *core)
{
    free(core->avr->flash);
    core->avr->flash = core->image->flash;
    if (core->flash != NULL)
        own_flash_attach(core->flash, core->avr);
}

static void wire(struct avr_core *core)
{
    avr_t *avr = core->avr;
    uint32_t no_flags = 0; /* else it prints what is sent, and sleeps while it is polled */

    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &no_flags);
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('1'), &no_flags);
    avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT),
                            byte_sent, core);
    avr->vcc = avr->avcc = avr->aref = ADC_REFERENCE_MV;
    avr_core_set_battery(core, BATTERY_FULL_MV);
}

struct avr_core *avr_core_new(const struct avr_image *image)
{
    return avr_core_new_with_flash(image, NULL);
}

struct avr_core *avr_core_new_with_flash(const struct avr_image *image, struct own_flash *flash)
{
    struct avr_core *core = calloc(1, sizeof *core);
    avr_t *avr = avr_make_mcu_by_name("atmega128");

    if (core == NULL || avr == NULL) {
        free(core);
        free(avr);
        return NULL;
    }
    core->avr = avr;
    core->image = image;
    core->flash = flash;
    core->sp_least = SRAM_END;
    if (avr_global_logger_get() != note_fault)
        avr_global_logger_set(note_fault); /* simavr's one global: written once */
    avr->reset_pc = flash != NULL ? LOADER_START : 0;
    avr_init(avr);
    avr->custom.data = core;
    avr->frequency = image->f_cpu;
    avr->sleep = sleep_through;
    take_flash(core);
    core->uart = module_of(avr, UDR0);
    fill_ram(avr->data);
    hook_registers(core);
    wire(core);
    append_io(core);
    after_reset(&core->last_reset);
    core->resets = 0;
    return core;
}

/* What avr_terminate() leaves behind. */
static void free_irqs(avr_t *avr)
{
    const uint32_t per_register = 9; /* one a bit, one for all */
    avr_watchdog_t *watchdog = module_of(avr, WDTCR);

    avr_free_irq(watchdog->watchdog.irq, AVR_INT_IRQ_COUNT);
    for (int i = 0; i < avr->interrupts.vector_count; i++)
        avr_free_irq(avr->interrupts.vector[i]->irq, AVR_INT_IRQ_COUNT);
    avr_free_irq(avr->interrupts.irq, AVR_INT_IRQ_COUNT);
    for (int i = 0; i < MAX_IOs; i++)
        avr_free_irq(avr->io[i].irq, per_register);
    free(avr->irq_pool.irq);
}

void avr_core_free(struct avr_core *core)
{
    avr_t *avr = core->avr;

    avr->flash = NULL; /* not its own */
    avr_terminate(avr);
    free_irqs(avr);
    free(avr);
    free(core);
}

void avr_core_write_eeprom(struct avr_core *core, uint16_t address, const uint8_t *bytes,
                           uint16_t count)
{
    avr_eeprom_desc_t what = {(uint8_t *)bytes, address, count};

    avr_ioctl(core->avr, AVR_IOCTL_EEPROM_SET, &what);
}

void avr_core_read_eeprom(struct avr_core *core, uint16_t address, uint8_t *bytes, uint16_t count)
{
    avr_eeprom_desc_t what = {bytes, address, count};

    avr_ioctl(core->avr, AVR_IOCTL_EEPROM_GET, &what);
}

void avr_core_set_battery(struct avr_core *core, uint16_t millivolts)
{
    avr_raise_irq(avr_io_getirq(core->avr, AVR_IOCTL_ADC_GETIRQ, BATTERY_CHANNEL),
                  millivolts / BATTERY_DIVIDER);
}

static bool alive(const struct avr_core *core)
{
    return !core->faulted && (core->flash == NULL || core->flash->fault == NULL) &&
           (core->avr->state == cpu_Running || core->avr->state == cpu_Sleeping);
}

bool avr_core_run(struct avr_core *core, uint64_t until)
{
    avr_t *avr = core->avr;

    core->until = until;
    at_cycle(core, until, stop);
    while (avr->cycle < until && alive(core)) {
        if (core->flash != NULL && own_flash_watches(core->flash))
            own_flash_step(core->flash);
        else
            avr->run(avr);
    }
    return alive(core);
}

void avr_core_reset(struct avr_core *core)
{
    avr_reset(core->avr);
    core->avr->data[MCUCSR] |= MCUCSR_EXTRF;
}

uint64_t avr_core_cycle(const struct avr_core *core)
{
    return core->avr->cycle;
}

uint64_t avr_core_asleep(const struct avr_core *core)
{
    return core->asleep;
}

unsigned avr_core_resets(const struct avr_core *core)
{
    return core->resets;
}

uint64_t avr_core_timer_start(const struct avr_core *core)
{
    return core->timer_start;
}

void avr_core_receive(struct avr_core *core, uint64_t start, const uint8_t *bytes, size_t count)
{
    core->arriving = bytes;
    core->arriving_count = count;
    core->arriving_start = start;
    core->arrived = 0;
    if (count > 0)
        at_cycle(core, arrival(core), byte_arrives);
}

size_t avr_core_take_sent(struct avr_core *core, uint8_t *bytes, size_t room)
{
    size_t count = core->sent_count < room ? core->sent_count : room;

    memcpy(bytes, core->sent, count);
    core->sent_count -= count;
    memmove(core->sent, core->sent + count, core->sent_count);
    return count;
}

static bool driven(const uint8_t *data, uint16_t port, uint16_t ddr, uint8_t mask)
{
    return data[port] & data[ddr] & mask;
}

#define DRIVEN(data, pin) driven(data, PIN_PORT(pin), PIN_DDR(pin), PIN_MASK(pin))

static int16_t word(const uint8_t *data, uint16_t address)
{
    return (int16_t)(data[address] | data[address + 1] << 8);
}

static int16_t signed_steps(int16_t steps, bool forward, bool reverse)
{
    return forward == reverse ? 0 : forward ? steps : (int16_t)-steps;
}

struct avr_motors avr_core_motors(const struct avr_core *core)
{
    const uint8_t *data = core->avr->data;
    bool pwm = data[TCCR3A] == TCCR3A_MODE && data[TCCR3B] == TCCR3B_MODE &&
               word(data, ICR3L) == PWM_STEPS &&
               data[PIN_DDR(PIN_LEFT_PWM)] & PIN_MASK(PIN_LEFT_PWM) &&
               data[PIN_DDR(PIN_RIGHT_PWM)] & PIN_MASK(PIN_RIGHT_PWM);

    if (!pwm)
        return (struct avr_motors){0, 0};
    return (struct avr_motors){
        signed_steps(word(data, OCR3AL), DRIVEN(data, PIN_LEFT_FORWARD),
                     DRIVEN(data, PIN_LEFT_REVERSE)),
        signed_steps(word(data, OCR3BL), DRIVEN(data, PIN_RIGHT_FORWARD),
                     DRIVEN(data, PIN_RIGHT_REVERSE)),
    };
}

static void write_ocdr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    struct avr_core *core = param;

    (void)address;
    core->heard(core->listener, value, avr->cycle);
}

void avr_core_on_debug(struct avr_core *core,
                       void (*heard)(void *listener, uint8_t byte, uint64_t cycle), void *listener)
{
    core->heard = heard;
    core->listener = listener;
    on_write(core, OCDR, write_ocdr, NULL);
}

bool avr_core_stack_overflown(const struct avr_core *core)
{
    return core->avr->data[core->image->data_end] != STACK_PAINT ||
           above_variables(core, core->sp_least) < 0;
}

static int painted(const struct avr_core *core)
{
    const uint8_t *data = core->avr->data;
    uint16_t at = core->image->data_end;

    while (at <= SRAM_END && data[at] == STACK_PAINT)
        at++;
    return at - core->image->data_end;
}

uint16_t avr_core_stack_free(const struct avr_core *core)
{
    int unwritten = painted(core);
    int unpassed = above_variables(core, core->sp_least);

    if (unpassed < 0)
        return 0;
    return (uint16_t)(unpassed < unwritten ? unpassed : unwritten);
}

void avr_core_watch_stack(struct avr_core *core)
{
    on_write(core, SPL, write_sp, NULL);
    on_write(core, SPH, write_sp, NULL);
}

const uint8_t *avr_core_data(const struct avr_core *core)
{
    return core->avr->data;
}
