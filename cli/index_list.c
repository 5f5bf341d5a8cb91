#include "index_list.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "arguments.h"
#include "number_file.h"

/* A list being read; `word` is what errors name. */
struct growing {
    struct session *session;
    const char *option;
    const struct row_span *span;
    struct index_list list;
    pia_index room;
};

pia_index row_in_file(const struct row_span *span, pia_index index)
{
    return span->row ? span->row[span->first + index] : span->first + index;
}

pia_index row_in_span(const struct row_span *span, pia_index file_row)
{
    if (span->any_order) {
        for (pia_index i = 0; i < span->count; i++)
            if (row_in_file(span, i) == file_row) return i;
        return -1;
    }
    if (!span->row) return file_row >= span->first && file_row < span->first + span->count ? file_row - span->first : -1;
    pia_index low = 0, high = span->count;
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (row_in_file(span, middle) < file_row)
            low = middle + 1;
        else
            high = middle;
    }
    return low < span->count && row_in_file(span, low) == file_row ? low : -1;
}

static void reserve(struct growing *growing, pia_index more)
{
    struct index_list *list = &growing->list;
    if (more <= growing->room - list->count) return;
    pia_index room = 2 * list->count + more;
    pia_index *item = session_keep(growing->session, (size_t)room, sizeof *item);
    if (list->count) memcpy(item, list->item, (size_t)list->count * sizeof *item);
    list->item = item;
    growing->room = room;
}

static void append(struct growing *growing, pia_index index)
{
    reserve(growing, 1);
    growing->list.item[growing->list.count++] = index;
}

/* The row of the file may lie in another part (left out) but not have been dropped. */
static int add_file_row(struct growing *growing, pia_index file_row)
{
    const struct row_span *span = growing->span;
    if (file_row < 0 || file_row >= span->total)
        return fail(EXIT_USAGE, "%s: there is no %lld; they run from 0 to %lld", growing->option, (long long)file_row,
                    (long long)span->total - 1);
    pia_index index = row_in_span(span, file_row);
    if (index < 0 && span->count && !span->any_order && file_row >= row_in_file(span, 0) &&
        file_row <= row_in_file(span, span->count - 1))
        return fail(EXIT_DATA, "%s: row %lld was dropped; leave it out of the list", growing->option, (long long)file_row);
    if (index < 0) return EXIT_DONE;
    append(growing, index);
    return EXIT_DONE;
}

static int add_range(struct growing *growing, pia_index from, pia_index to)
{
    if (to >= growing->span->total) return add_file_row(growing, to);
    reserve(growing, to - from + 1);
    for (pia_index row = from; row <= to; row++) {
        int code = add_file_row(growing, row);
        if (code) return code;
    }
    return EXIT_DONE;
}

static void add_every(struct growing *growing, pia_index step)
{
    pia_index count = growing->span->count;
    reserve(growing, count ? (count - 1) / step + 1 : 0);
    for (pia_index index = 0; index < count; index += step) append(growing, index);
}

static void add_ends(struct growing *growing)
{
    if (!growing->span->count) return;
    append(growing, 0);
    append(growing, growing->span->count - 1);
}

/* One word between commas; -1 when it is no word of a list. */
static int add_word(struct growing *growing, char *word)
{
    pia_index from, to;
    if (text_is_count(word, &from)) return add_file_row(growing, from);
    if (strcmp(word, "ends") == 0) {
        add_ends(growing);
        return EXIT_DONE;
    }
    if (strncmp(word, "every:", 6) == 0 && text_is_count(word + 6, &from) && from > 0) {
        add_every(growing, from);
        return EXIT_DONE;
    }
    char *dash = strchr(word, '-');
    if (!dash) return -1;
    *dash = 0;
    int range = text_is_count(word, &from) && text_is_count(dash + 1, &to) && from <= to;
    *dash = '-';
    return range ? add_range(growing, from, to) : -1;
}

static int add_text(struct growing *growing, const char *text)
{
    char *copy = session_text(growing->session, "%s", text), *rest = copy, *word;
    while ((word = strsep(&rest, ","))) {
        int code = add_word(growing, word);
        if (code) return code;
    }
    return EXIT_DONE;
}

static int add_file(struct growing *growing, const char *path)
{
    struct numbers numbers;
    int code = numbers_read(growing->session, path, &numbers);
    for (pia_index i = 0; !code && i < numbers.count; i++) {
        double value = numbers.value[i];
        if (value != (double)(pia_index)value || value < 0 || value >= (double)growing->span->total)
            return fail(EXIT_DATA, "%s: %g is not an index from 0 to %lld; correct it", numbers_place(growing->session, &numbers, i),
                        value, (long long)growing->span->total - 1);
        code = add_file_row(growing, (pia_index)value);
    }
    return code;
}

static int compare(const void *a, const void *b)
{
    pia_index x = *(const pia_index *)a, y = *(const pia_index *)b;
    return (x > y) - (x < y);
}

static void sort_each_once(struct index_list *list)
{
    if (list->count) qsort(list->item, (size_t)list->count, sizeof *list->item, compare);
    pia_index kept = 0;
    for (pia_index i = 0; i < list->count; i++)
        if (i == 0 || list->item[i] != list->item[i - 1]) list->item[kept++] = list->item[i];
    list->count = kept;
}

int index_list_read(struct session *session, const char *option, const char *text, const struct row_span *span, struct index_list *out)
{
    struct growing growing = {.session = session, .option = option, .span = span};
    int code = add_text(&growing, text);
    if (code < 0 && (strcmp(text, "-") == 0 || access(text, F_OK) == 0)) {
        growing.list.count = 0;
        code = add_file(&growing, text);
    } else if (code < 0)
        code = fail(EXIT_USAGE, "%s: '%s' is neither a list nor a file; write 0,40,80-90 or every:50 or ends", option, text);
    if (code) return code;
    sort_each_once(&growing.list);
    *out = growing.list;
    return EXIT_DONE;
}
