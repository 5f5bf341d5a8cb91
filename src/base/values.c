#include "values.h"

#include "number.h"

#include <math.h>
#include <string.h>

/* The index of `word` in "a|b|c", or -1. */
static int word_index(const char *words, const char *word, size_t length)
{
    int index = 0;
    for (const char *at = words; at != NULL; index++) {
        const char *bar = strchr(at, '|');
        size_t size = bar != NULL ? (size_t)(bar - at) : strlen(at);
        if (size == length && memcmp(at, word, length) == 0) return index;
        at = bar != NULL ? bar + 1 : NULL;
    }
    return -1;
}

/* Fills entry i from text; returns 0 when the parameter does not take it. */
static int assign(const pia_parameter *parameter, const char *text, int i, pia_values *values)
{
    size_t length = strlen(text);
    int takes_number = parameter->values == NULL;
    if (parameter->values != NULL) {
        int number_word = word_index(parameter->values, "number", 6);
        int word = word_index(parameter->values, text, length);
        takes_number = number_word >= 0;
        if (word >= 0 && word != number_word) {
            values->number[i] = word;
            values->is_word[i] = 1;
            return 1;
        }
    }
    double number;
    const char *end = pia_number_parse(text, text + length, &number);
    if (!takes_number || end != text + length || !(number >= parameter->minimum && number <= parameter->maximum)) return 0;
    values->number[i] = number;
    values->is_word[i] = 0;
    return 1;
}

void pia_values_default(const pia_parameter *parameters, pia_values *out)
{
    memset(out, 0, sizeof *out);
    if (parameters == NULL) return;
    for (int i = 0; parameters[i].name != NULL; i++) assign(&parameters[i], parameters[i].initial, i, out);
}

static void list_names(const pia_parameter *parameters, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; parameters != NULL && parameters[i].name != NULL; i++) {
        size_t length = strlen(parameters[i].name);
        if (used + length + 3 > size) return;
        if (i > 0) {
            memcpy(text + used, ", ", 3);
            used += 2;
        }
        memcpy(text + used, parameters[i].name, length + 1);
        used += length;
    }
}

pia_status pia_values_set(pia_context *context, const char *record, const pia_parameter *parameters, const char *name,
                          const char *value, pia_values *values)
{
    for (int i = 0; parameters != NULL && parameters[i].name != NULL; i++) {
        const pia_parameter *p = &parameters[i];
        if (strcmp(p->name, name) != 0) continue;
        if (assign(p, value, i, values)) return PIA_OK;
        if (p->values != NULL && strstr(p->values, "number") == NULL)
            return pia_fail(context, PIA_E_ARGUMENT, "%s: %s=%s is unknown; choose one of %s", record, name, value, p->values);
        return pia_fail(context, PIA_E_ARGUMENT, "%s: %s=%s is out of range; give %s%sa number from %g to %g", record, name, value,
                        p->values != NULL ? p->values : "", p->values != NULL ? " with " : "", p->minimum, p->maximum);
    }
    char names[256];
    list_names(parameters, names, sizeof names);
    if (names[0] == '\0') return pia_fail(context, PIA_E_ARGUMENT, "%s has no option %s; it has none at all", record, name);
    return pia_fail(context, PIA_E_ARGUMENT, "%s has no option %s; it knows %s", record, name, names);
}

pia_status pia_values_read(pia_context *context, const char *record, const pia_parameter *parameters, const char *const *texts,
                           pia_index count, pia_values *values)
{
    pia_values_default(parameters, values);
    for (pia_index i = 0; i < count; i++) {
        char name[64];
        const char *equals = texts[i] != NULL ? strchr(texts[i], '=') : NULL;
        if (equals == NULL || equals == texts[i] || (size_t)(equals - texts[i]) >= sizeof name)
            return pia_fail(context, PIA_E_ARGUMENT, "%s: option \"%s\" is no setting; write NAME=VALUE", record,
                            texts[i] != NULL ? texts[i] : "");
        memcpy(name, texts[i], (size_t)(equals - texts[i]));
        name[equals - texts[i]] = '\0';
        pia_status status = pia_values_set(context, record, parameters, name, equals + 1, values);
        if (status != PIA_OK) return status;
    }
    return PIA_OK;
}
