#include "update.h"

#include "message.h"

#include <stdio.h>
#include <string.h>

/* How often it is asked who is there. */
#define CALL_US 300000

/* From leaving the loader to the first word of what was installed: a program that fills its slot
 * takes 2.4 s to copy. Until then the loader is not called, which would keep the program from
 * starting. */
#define INSTALL_US 4000000

/* A robot of another making is none to write to. */
static const uint8_t signature[3] = {0x1E, 0x97, 0x02};

/* Answers in a row that did not come, and it is looked again who is there. */
#define LATE_MAX 3

/* Times that a page is written, and that the loader is left, before it is given up. */
#define TRIES 5

static struct update *update_of(struct job *job)
{
    return (struct update *)job;
}

/* An older program, which knows no call: somebody has to reset the robot. */
static bool is_by_hand(const struct update *update)
{
    return update->step == UPDATE_CALL && !update->met;
}

/* ---- words ----------------------------------------------------------------------------- */

void update_standing(const struct update *update, char words[JOB_WORDS_MAX])
{
    if (update->staged)
        snprintf(words, JOB_WORDS_MAX, "has %08lX, which it installs by itself",
                 (unsigned long)update->program->crc);
    else if (update->met)
        snprintf(words, JOB_WORDS_MAX, "still has %08lX, which runs%s", (unsigned long)update->runs,
                 update->in_loader ? " again in 10 s" : "");
    else
        snprintf(words, JOB_WORDS_MAX, "has the program that it had");
}

static void fail(struct update *update, const char *why)
{
    char standing[JOB_WORDS_MAX];

    update_standing(update, standing);
    job_failed(&update->job, "%.90s; it %.64s", why, standing);
    update->told = true;
}

static void give_up(struct update *update)
{
    char why[JOB_WORDS_MAX];

    if (update->why[0] != '\0')
        snprintf(why, sizeof why, "link down: %.70s", update->why);
    else if (update->in_loader)
        snprintf(why, sizeof why, "its boot loader does not answer any more");
    else if (update->step == UPDATE_CALL)
        snprintf(why, sizeof why, "does not go to its boot loader: has it one? (`make flash')");
    else if (update->leaves > 0)
        snprintf(why, sizeof why, "is silent since its update was whole");
    else
        snprintf(why, sizeof why, "does not answer: is it on, and its radio at %lu baud?",
                 (unsigned long)update->program->baud);
    fail(update, why);
}

static void show(struct update *update)
{
    struct job *job = &update->job;
    uint16_t pages = program_pages(update->program);

    job->progress = (double)update->page / (pages + 1);
    switch (update->step) {
    case UPDATE_LOOK:
        snprintf(job->words, sizeof job->words, "%s",
                 update->leaves > 0 ? "installs" : "looks who is there");
        break;
    case UPDATE_ASK: snprintf(job->words, sizeof job->words, "is asked what it runs"); break;
    case UPDATE_CALL:
        snprintf(job->words, sizeof job->words, "%s",
                 is_by_hand(update) ? "does not know the call: reset it now"
                                    : "is called to its boot loader");
        break;
    default:
        snprintf(job->words, sizeof job->words, "page %u of %u", (unsigned)update->page, pages);
        break;
    }
}

/* ---- the loader, asked ----------------------------------------------------------------- */

static uint16_t page_at(const struct update *update)
{
    return program_page_at(update->program, update->page);
}

/* The loader stands at the page: it moves on by itself with each that it reads or writes. */
static bool is_aimed(const struct update *update)
{
    return update->aim == page_at(update);
}

static void ask(struct update *update)
{
    struct stk500 *loader = &update->loader;
    bool of_page = update->step == UPDATE_COMPARE || update->step == UPDATE_WRITE ||
                   update->step == UPDATE_VERIFY;

    if (of_page && !is_aimed(update)) {
        stk500_load_address(loader, page_at(update));
        return;
    }
    switch (update->step) {
    case UPDATE_ENTER: stk500_enter_progmode(loader); break;
    case UPDATE_SIGNATURE: stk500_read_signature(loader, update->signature); break;
    case UPDATE_COMPARE:
    case UPDATE_VERIFY: stk500_read_flash(loader, FLASH_PAGE_BYTES); break;
    case UPDATE_WRITE:
        stk500_program_flash(loader, update->program->slot + page_at(update), FLASH_PAGE_BYTES);
        break;
    case UPDATE_LEAVE: stk500_leave_progmode(loader); break;
    default: break;
    }
}

/* ---- steps ----------------------------------------------------------------------------- */

static void go_to(struct update *update, enum update_step step)
{
    update->step = step;
    update->late = 0;
    ask(update);
    show(update);
}

static void look(struct update *update, int64_t now_us)
{
    stk500_forget(&update->loader);
    update->due_us = now_us + (update->staged ? INSTALL_US : 0);
    update->calls = false;
    go_to(update, UPDATE_LOOK);
}

static void ask_program(struct update *update)
{
    stk500_forget(&update->loader);
    talk_ask(&update->talk, PARAMETER_GET, PARAMETER_IMAGE, 0);
    go_to(update, UPDATE_ASK);
}

static void call(struct update *update, int64_t now_us)
{
    update->due_us = now_us;
    update->calls = true;
    go_to(update, UPDATE_CALL);
}

/* With the page that is next. */
static void go_on(struct update *update, enum update_step step)
{
    update->writes = 0;
    update->staged |= update->page == program_pages(update->program);
    go_to(update, update->page == program_pages(update->program) ? UPDATE_LEAVE : step);
}

/* ---- the program answers --------------------------------------------------------------- */

static void judge_id(struct update *update)
{
    const struct talk *talk = &update->talk;
    struct job *job = &update->job;

    if (update->options.force || job->robot == 0 || talk->id == 0 || talk->id == job->robot)
        return;
    job_failed(job, "robot %u answers there: mend the site file; --force updates it all the same",
               talk->id);
    update->told = true;
}

/* The last answer of a loader that was left may be lost. */
static bool was_given(const struct update *update)
{
    return update->staged || update->leaves > 0;
}

static void finish(struct update *update)
{
    unsigned long crc = (unsigned long)update->program->crc;

    if (!was_given(update))
        job_done(&update->job, "has %08lX already", crc);
    else if (update->met)
        job_done(&update->job, "%08lX -> %08lX, verified, runs", (unsigned long)update->runs, crc);
    else
        job_done(&update->job, "%08lX, verified, runs", crc);
}

/* It runs the program `crc`. */
static void judge_program(struct update *update, uint32_t crc, int64_t now_us)
{
    if (crc == update->program->crc && (!update->options.again || was_given(update))) {
        finish(update);
        return;
    }
    update->met = true;
    update->runs = crc;
    update->staged = false;
    if (update->leaves >= TRIES)
        fail(update, "does not take the update, though it was read back whole");
    else
        call(update, now_us);
}

static void hear_program(struct update *update, int64_t now_us)
{
    const struct talk *talk = &update->talk;
    bool news = talk->statuses != update->heard;

    update->in_loader &= !news;
    update->heard = talk->statuses;
    if (news && update->step != UPDATE_ASK && update->step != UPDATE_CALL) {
        ask_program(update);
        judge_id(update);
    }
    if (update->job.state != JOB_WORKING || update->step != UPDATE_ASK ||
        talk->state == TALK_ASKING)
        return;
    if (talk->state == TALK_ANSWERED && talk->answer.result == PARAMETER_DONE)
        judge_program(update, talk->answer.value, now_us);
    else /* one that is older may still be called, or be reset by hand */
        call(update, now_us);
}

/* ---- the loader answers ---------------------------------------------------------------- */

/* After it was left with a whole stage, a loader that is still there may have found it not so. */
static void meet_loader(struct update *update, int64_t now_us)
{
    if (is_by_hand(update))
        update->moved_us = now_us;
    if (update->leaves > 0)
        update->page = 0;
    if (update->leaves >= TRIES)
        fail(update, "stays in its boot loader");
    else
        go_to(update, UPDATE_ENTER);
}

static void take_signature(struct update *update)
{
    if (stk500_signature(&update->loader) != signature[update->signature]) {
        fail(update, "is no ATmega128");
        return;
    }
    if (++update->signature < sizeof signature)
        ask(update);
    else
        go_on(update, UPDATE_COMPARE);
}

static void take_page(struct update *update, int64_t now_us)
{
    const uint8_t *wanted = update->program->slot + page_at(update);

    if (memcmp(stk500_flash(&update->loader), wanted, FLASH_PAGE_BYTES) == 0) {
        update->page++;
        update->loader.slow -= update->loader.slow > 0;
        update->moved_us = now_us;
        go_on(update, update->step == UPDATE_COMPARE ? UPDATE_COMPARE : UPDATE_WRITE);
    } else if (update->writes < TRIES) {
        update->staged = false;
        go_to(update, UPDATE_WRITE);
    } else {
        fail(update, "a page of its flash does not keep what is written to it");
    }
}

/* The loader stands at the page now; or what was asked for there is done. */
static void go_on_with_page(struct update *update, int64_t now_us)
{
    if (!is_aimed(update)) {
        update->aim = page_at(update);
        ask(update);
        return;
    }
    update->aim += FLASH_PAGE_BYTES;
    if (update->step == UPDATE_WRITE) {
        update->writes++;
        go_to(update, UPDATE_VERIFY);
    } else {
        take_page(update, now_us);
    }
}

static void hear_loader(struct update *update, int64_t now_us)
{
    if (!stk500_agreed(&update->loader)) {
        look(update, now_us);
        return;
    }
    update->in_loader = true;
    update->late = 0;
    switch (update->step) {
    case UPDATE_ASK: break;
    case UPDATE_LOOK:
    case UPDATE_CALL: meet_loader(update, now_us); break;
    case UPDATE_ENTER:
        update->signature = 0;
        update->aim = UPDATE_AIM_UNKNOWN;
        go_to(update, UPDATE_SIGNATURE);
        break;
    case UPDATE_SIGNATURE: take_signature(update); break;
    case UPDATE_COMPARE:
    case UPDATE_WRITE:
    case UPDATE_VERIFY: go_on_with_page(update, now_us); break;
    case UPDATE_LEAVE:
        update->leaves++;
        update->moved_us = now_us;
        update->in_loader = false;
        look(update, now_us);
        break;
    }
}

/* An answer has not come. */
static void repeat(struct update *update, int64_t now_us)
{
    if (++update->late == LATE_MAX) {
        look(update, now_us);
        return;
    }
    if (update->loader.slow < STK500_SLOW_MAX)
        update->loader.slow++;
    update->aim = UPDATE_AIM_UNKNOWN;
    ask(update);
}

/* ---- the job --------------------------------------------------------------------------- */

/* Time counts from the first call on. */
static void begin(struct update *update, int64_t now_us)
{
    if (!update->begun)
        update->moved_us = update->down_us = now_us;
    update->begun = true;
}

static void linked(struct job *job, int64_t now_us)
{
    struct update *update = update_of(job);

    begin(update, now_us);
    update->moved_us += now_us - update->down_us;
    update->why[0] = '\0';
    talk_linked(&update->talk, now_us);
    look(update, now_us);
}

static void lost(struct job *job, const char *words, int64_t now_us)
{
    struct update *update = update_of(job);

    talk_lost(&update->talk);
    update->down_us = now_us;
    look(update, now_us);
    snprintf(update->why, sizeof update->why, "%s", words);
    snprintf(job->words, sizeof job->words, "%s", words);
}

static void received(struct job *job, const uint8_t *bytes, size_t count, int64_t now_us)
{
    struct update *update = update_of(job);

    talk_received(&update->talk, bytes, count, now_us);
    hear_program(update, now_us);
    for (size_t i = 0; i < count && job->state == JOB_WORKING; i++)
        if (stk500_take(&update->loader, bytes[i]))
            hear_loader(update, now_us);
}

/* The program is called away, and in between the loader is asked whether it is there already. */
static size_t send_call(struct update *update, int64_t now_us, uint8_t *bytes, size_t used,
                        size_t room)
{
    static const struct message leave = {.type = MESSAGE_LOADER};
    size_t with = used;

    if (now_us < update->due_us)
        return used;
    if (update->calls)
        with = talk_put(&leave, bytes, used, room);
    else
        stk500_sign_on(&update->loader);
    update->due_us = now_us + CALL_US / 2;
    update->calls = !update->calls;
    return with;
}

static size_t send_frames(struct update *update, int64_t now_us, uint8_t *bytes, size_t room)
{
    size_t used = 0;

    if (room == 0)
        return 0;
    /* Ends what the frame would else be taken for a part of. */
    bytes[used++] = 0;
    used += talk_send(&update->talk, now_us, bytes + used, room - used);
    if (update->step == UPDATE_CALL)
        used = send_call(update, now_us, bytes, used, room);
    return used > 1 ? used : 0;
}

/* Returns how many bytes go before what the loader is asked. */
static size_t look_after_loader(struct update *update, int64_t now_us, uint8_t *bytes, size_t room)
{
    if (update->step == UPDATE_LOOK && now_us >= update->due_us && room > 0) {
        stk500_sign_on(&update->loader);
        update->due_us = now_us + CALL_US;
        /* Where it is the program that hears it, that shall not leave without a word: a SIGN_ON
         * that follows upon another one would call it away (brain.c). */
        bytes[0] = 0;
        return 1;
    }
    if (update->step >= UPDATE_ENTER && stk500_late(&update->loader, now_us))
        repeat(update, now_us);
    return 0;
}

/* While the link is down nothing can go on; dialling has a patience of its own. */
static bool is_over(const struct update *update, int64_t now_us)
{
    if (!update->talk.linked)
        return now_us - update->down_us > UPDATE_LONG_PATIENCE_US;
    return now_us - update->moved_us >
           (is_by_hand(update) ? UPDATE_LONG_PATIENCE_US : UPDATE_PATIENCE_US);
}

static size_t send(struct job *job, int64_t now_us, uint8_t *bytes, size_t room)
{
    struct update *update = update_of(job);
    size_t used = 0;

    begin(update, now_us);
    if (is_over(update, now_us)) {
        give_up(update);
        return 0;
    }
    if (!update->talk.linked)
        return 0;
    if (update->step == UPDATE_ASK || update->step == UPDATE_CALL)
        used = send_frames(update, now_us, bytes, room);
    hear_program(update, now_us);
    used += look_after_loader(update, now_us, bytes + used, room - used);
    return used + stk500_send(&update->loader, now_us, bytes + used, room - used);
}

static const struct job_kind kind = {linked, lost, received, NULL, send};

void update_begin(struct update *update, const struct program *program, uint16_t robot,
                  const struct update_options *options)
{
    memset(update, 0, sizeof *update);
    update->job.kind = &kind;
    update->job.robot = robot;
    update->options = *options;
    update->program = program;
    stk500_begin(&update->loader, program->baud);
    talk_begin(&update->talk);
    show(update);
}
