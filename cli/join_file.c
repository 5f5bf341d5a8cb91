#include "join_file.h"

#include <string.h>

static int refuse(const char *place, const char *what)
{
    return fail(EXIT_DATA, "%s: %s; correct it", place, what);
}

static const char *text_of(const json_t *item, const char *key)
{
    return json_string_value(json_object_get(item, key));
}

/* "start" and "end" are those of a curve, and of direction u. */
static int read_edge(const char *text, pia_edge *out)
{
    static const char *const names[] = {"u0", "u1", "v0", "v1"}, *const ends[] = {"start", "end"};
    for (int i = 0; i < 4; i++)
        if (strcmp(text, names[i]) == 0 || (i < 2 && strcmp(text, ends[i]) == 0)) {
            *out = (pia_edge)i;
            return 1;
        }
    return 0;
}

static int read_continuity(const char *text, pia_continuity *out)
{
    static const char *const names[] = {"C0", "G1", "C1"};
    for (int i = 0; i < 3; i++)
        if (strcmp(text, names[i]) == 0) {
            *out = (pia_continuity)i;
            return 1;
        }
    return 0;
}

/* The start of one goes on from the end of the other. */
static pia_edge opposite(pia_edge edge)
{
    return edge == PIA_EDGE_U_START   ? PIA_EDGE_U_END
           : edge == PIA_EDGE_U_END   ? PIA_EDGE_U_START
           : edge == PIA_EDGE_V_START ? PIA_EDGE_V_END
                                      : PIA_EDGE_V_START;
}

static int check_keys(const char *place, json_t *item)
{
    const char *key;
    json_t *member;
    json_object_foreach(item, key, member)
    {
        int known = !strcmp(key, "join") || !strcmp(key, "end") || !strcmp(key, "to") || !strcmp(key, "continuity");
        if (!known && strcmp(key, "reversed") != 0)
            return fail(EXIT_DATA, "%s: unknown key \"%s\"; join, end, to, continuity, reversed", place, key);
        if (known ? !json_is_string(member) : !json_is_boolean(member))
            return fail(EXIT_DATA, "%s: \"%s\" must be %s; correct it", place, key, known ? "a text" : "true or false");
    }
    return EXIT_DONE;
}

int join_file_read(struct session *session, const char *place, json_t *item, struct model_set *neighbour, pia_join *out)
{
    const pia_model *model;
    int code = check_keys(place, item);
    if (code) return code;
    const char *end = text_of(item, "end"), *to = text_of(item, "to"), *continuity = text_of(item, "continuity");
    pia_join_init(out);
    if (!end || !read_edge(end, &out->edge)) return refuse(place, "\"end\" must be start or end, of a surface u0, u1, v0 or v1");
    out->neighbour_edge = opposite(out->edge);
    if (to && !read_edge(to, &out->neighbour_edge)) return refuse(place, "\"to\" must be start or end, of a surface u0, u1, v0 or v1");
    if (continuity && !read_continuity(continuity, &out->continuity)) return refuse(place, "\"continuity\" must be C0, G1 or C1");
    out->reversed = json_is_true(json_object_get(item, "reversed"));
    code = models_open(session, session_text(session, "%s", text_of(item, "join")), NULL, neighbour);
    if (!code) code = models_choose(neighbour, PIA_AUTO, &model);
    if (!code) out->neighbour = model;
    return code;
}
