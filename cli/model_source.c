#include "model_source.h"

#include "file_name.h"

int models_open(struct session *session, const char *path, const char *format, struct model_set *out)
{
    *out = (struct model_set){.path = path};
    pia_status status = pia_model_read(session->context, path, format_of(path, format, "json"), &out->model, &out->count);
    return session_check(session, status, path);
}

void models_close(struct model_set *set)
{
    pia_models_destroy(set->model, set->count);
    set->model = NULL;
    set->count = 0;
}

int models_choose(const struct model_set *set, pia_index part, const pia_model **out)
{
    if (part == PIA_AUTO && set->count > 1)
        return fail(EXIT_USAGE, "%s: holds %lld models; choose one with --part, from 0", set->path, (long long)set->count);
    pia_index index = part == PIA_AUTO ? 0 : part;
    if (index >= set->count)
        return fail(EXIT_USAGE, "%s: there is no model %lld; the file has %lld, counted from 0", set->path, (long long)index,
                    (long long)set->count);
    *out = set->model[index];
    return EXIT_DONE;
}
