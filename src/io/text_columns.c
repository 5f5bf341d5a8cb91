#include "text.h"

#include <string.h>

/* The field with that name; -1 when there is none. */
static pia_index find_name(const pia_text_layout *layout, const char *text, size_t length)
{
    pia_text_field field;
    const char *p = layout->names.begin;
    for (pia_index i = 0; p != NULL && pia_text_next_field(&layout->names, layout->delimiter, &p, &field); i++)
        if ((size_t)(field.end - field.begin) == length && memcmp(field.begin, text, length) == 0) return i;
    return -1;
}

/* The field with that name, or the number from 1 that the text spells; -1 when there is none. */
static pia_index find_field(const pia_text_layout *layout, const char *text, size_t length)
{
    pia_index named = find_name(layout, text, length), number = 0;
    if (named >= 0) return named;
    for (size_t i = 0; i < length && number <= layout->field_count; i++) {
        if (text[i] < '0' || text[i] > '9') return -1;
        number = number * 10 + (text[i] - '0');
    }
    return number <= layout->field_count ? number - 1 : -1;
}

static void choose_numeric(const pia_text_layout *layout, pia_text_columns *columns)
{
    for (pia_index f = 0; f < layout->field_count; f++) {
        if (!layout->numeric[f]) continue;
        columns->slot[f] = columns->count;
        columns->field[columns->count++] = f;
    }
}

static pia_status refuse_column(pia_context *context, const pia_input *input, const pia_text_layout *layout, const char *name,
                                int length)
{
    char names[200] = "it has no names";
    size_t size = (size_t)(layout->names.end - layout->names.begin);
    if (layout->names.begin != NULL && size < sizeof names) {
        memcpy(names, layout->names.begin, size);
        names[size] = '\0';
    }
    return pia_fail(context, PIA_E_ARGUMENT, "%s: there is no column '%.*s'; give names (%s) or numbers from 1 to %lld", input->path,
                    length, name, names, (long long)layout->field_count);
}

static pia_status choose_listed(pia_context *context, const pia_input *input, const pia_text_layout *layout, const char *list,
                                pia_text_columns *columns)
{
    for (;;) {
        list += strspn(list, " \t");
        size_t end = strcspn(list, ","), length = end;
        while (length > 0 && pia_text_is_blank(list[length - 1])) length--;
        size_t shown = length < 40 ? length : 40;
        pia_index f = find_field(layout, list, length);
        if (f < 0) return refuse_column(context, input, layout, list, (int)shown);
        if (columns->slot[f] >= 0)
            return pia_fail(context, PIA_E_ARGUMENT, "column '%.*s' is listed twice; list each column once", (int)shown, list);
        columns->slot[f] = columns->count;
        columns->field[columns->count++] = f;
        if (list[end] == '\0') return PIA_OK;
        list += end + 1;
    }
}

pia_status pia_text_choose_columns(pia_context *context, const pia_input *input, const pia_text_layout *layout, const char *list,
                                   pia_text_columns *out)
{
    pia_text_columns columns = {.slot = pia_take(context, layout->field_count, sizeof *columns.slot),
                                .field = pia_take(context, layout->field_count, sizeof *columns.field),
                                .contour = -1};
    pia_status status = PIA_OK;
    if (columns.slot == NULL || columns.field == NULL) {
        status = pia_take_status(context, layout->field_count, sizeof *columns.slot);
    } else {
        for (pia_index f = 0; f < layout->field_count; f++) columns.slot[f] = -1;
        if (list == NULL)
            choose_numeric(layout, &columns);
        else
            status = choose_listed(context, input, layout, list, &columns);
    }
    if (status == PIA_OK) {
        *out = columns;
    } else {
        pia_give(context, columns.slot);
        pia_give(context, columns.field);
    }
    return status;
}

void pia_text_set_contour_apart(const pia_text_layout *layout, int listed, pia_text_columns *columns)
{
    static const char name[] = "contour";
    pia_index contour = find_name(layout, name, sizeof name - 1);
    pia_index slot = contour >= 0 ? columns->slot[contour] : -1;
    if (slot >= 0 && (listed || columns->count == 1)) return;
    columns->contour = contour;
    if (slot < 0) return;
    columns->slot[contour] = -1;
    columns->count--;
    for (pia_index k = slot; k < columns->count; k++) {
        columns->field[k] = columns->field[k + 1];
        columns->slot[columns->field[k]] = k;
    }
}

pia_status pia_text_copy_names(pia_context *context, const pia_text_layout *layout, const pia_text_columns *columns, pia_points *out)
{
    if (layout->names.begin == NULL) return PIA_OK;
    out->names = pia_take_zero(context, columns->count, sizeof *out->names);
    if (out->names == NULL) return pia_take_status(context, columns->count, sizeof *out->names);
    const char *p = layout->names.begin;
    pia_text_field field;
    for (pia_index f = 0; pia_text_next_field(&layout->names, layout->delimiter, &p, &field); f++) {
        if (columns->slot[f] < 0) continue;
        size_t length = (size_t)(field.end - field.begin);
        char *name = pia_take(context, (pia_index)length + 1, 1);
        if (name == NULL) return pia_take_status(context, (pia_index)length + 1, 1);
        memcpy(name, field.begin, length);
        name[length] = '\0';
        out->names[columns->slot[f]] = name;
    }
    return PIA_OK;
}
