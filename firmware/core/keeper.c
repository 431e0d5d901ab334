#include "keeper.h"

#include <string.h>

void keeper_init(struct keeper *keeper, const uint8_t eeprom[PARAMETERS_BYTES])
{
    memset(keeper, 0, sizeof *keeper);
    keeper->source = parameters_read(&keeper->parameters, eeprom);
    parameters_record(&keeper->parameters, keeper->source.sequence, keeper->record);
    keeper->kept = keeper->source.whole > 0;
}

void keeper_hear(struct keeper *keeper, const struct message_ask *ask)
{
    keeper->ask = *ask;
    keeper->asked = true;
}

static bool is_unsaved(const struct keeper *keeper)
{
    return !keeper->kept || memcmp(keeper->record + PARAMETERS_HEAD_BYTES, keeper->parameters.value,
                                   sizeof keeper->parameters.value) != 0;
}

static uint32_t value_of(const struct keeper *keeper, const struct keeper_view *view, uint8_t index)
{
    if (index < PARAMETERS_STORED_COUNT)
        return keeper->parameters.value[index];
    switch (index) {
    case PARAMETER_IMAGE: return view->image;
    case PARAMETER_RESETS: return view->resets;
    case PARAMETER_EEPROM: return keeper->source.whole;
    case PARAMETER_UNSAVED: return is_unsaved(keeper);
    default: return 0;
    }
}

static void answer(struct keeper *keeper, const struct keeper_view *view,
                   const struct message_ask *ask, uint8_t result)
{
    keeper->due = true;
    keeper->answer = (struct message_answer){
        .id = keeper->parameters.value[PARAMETER_ID],
        .tag = ask->tag,
        .result = result,
        .index = ask->index,
        .value = value_of(keeper, view, ask->index),
    };
}

/* ---- saving ---------------------------------------------------------------------------- */

static void begin_save(struct keeper *keeper)
{
    keeper->saver = keeper->ask;
    if (keeper->saving)
        return; /* the one that is under way will do */
    keeper->saving = true;
    keeper->stored = 0;
    keeper->kept = false;
    parameters_record(&keeper->parameters, keeper->source.sequence + 1, keeper->record);
}

static void end_save(struct keeper *keeper, const struct keeper_view *view, bool good)
{
    struct parameters_source *source = &keeper->source;

    keeper->saving = false;
    keeper->kept = good;
    if (good) {
        source->bank ^= 1;
        source->sequence++;
        source->whole += source->whole < 2;
    } else if (source->whole == 2) {
        source->whole = 1;
    }
    answer(keeper, view, &keeper->saver, good ? PARAMETER_DONE : PARAMETER_BROKEN);
}

/* Compares the byte before with what has become of it, and asks for the next one. */
static void save(struct keeper *keeper, const struct keeper_view *view, struct store *store)
{
    uint8_t next = keeper->stored;
    bool good = next == 0 || view->stored == keeper->record[next - 1];

    if (!good || next == PARAMETERS_RECORD_BYTES) {
        end_save(keeper, view, good);
        return;
    }
    store->wanted = true;
    store->at = (keeper->source.bank == 0 ? PARAMETERS_BANK_BYTES : 0) + next;
    store->byte = keeper->record[next];
    keeper->stored++;
}

/* ---- asks ------------------------------------------------------------------------------ */

static bool is_known(uint8_t index)
{
    return index < PARAMETERS_STORED_COUNT ||
           (index >= PARAMETERS_READ_FROM && index < PARAMETERS_END);
}

static uint8_t set(struct keeper *keeper, uint8_t index, uint32_t value, bool under_way)
{
    if (!is_known(index))
        return PARAMETER_UNKNOWN;
    if (index >= PARAMETERS_READ_FROM)
        return PARAMETER_READ_ONLY;
    if (!parameters_allow(index, value))
        return PARAMETER_RANGE;
    if (keeper->saving || (index == PARAMETER_ID && under_way))
        return PARAMETER_BUSY;
    keeper->parameters.value[index] = (uint16_t)value;
    return PARAMETER_DONE;
}

static uint8_t reset(struct keeper *keeper)
{
    uint16_t id = keeper->parameters.value[PARAMETER_ID];

    if (keeper->saving)
        return PARAMETER_BUSY;
    parameters_default(&keeper->parameters);
    keeper->parameters.value[PARAMETER_ID] = id;
    return PARAMETER_DONE;
}

/* True when parameters were changed. */
static bool attend(struct keeper *keeper, const struct keeper_view *view)
{
    const struct message_ask *ask = &keeper->ask;
    uint8_t result = PARAMETER_UNKNOWN;
    bool changes = false;

    keeper->asked = false;
    switch (ask->action) {
    case PARAMETER_GET: result = is_known(ask->index) ? PARAMETER_DONE : PARAMETER_UNKNOWN; break;
    case PARAMETER_SET:
        result = set(keeper, ask->index, ask->value, view->under_way);
        changes = true;
        break;
    case PARAMETER_SAVE:
        if (is_unsaved(keeper)) {
            begin_save(keeper);
            return false;
        }
        result = PARAMETER_DONE;
        break;
    case PARAMETER_RESET:
        result = reset(keeper);
        changes = true;
        break;
    }
    answer(keeper, view, ask, result);
    return changes && result == PARAMETER_DONE;
}

bool keeper_step(struct keeper *keeper, const struct keeper_view *view, struct store *store)
{
    if (keeper->due)
        return false; /* there is room for one answer */
    if (keeper->saving)
        save(keeper, view, store);
    return keeper->asked && !keeper->due && attend(keeper, view);
}
