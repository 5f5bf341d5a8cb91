/* json [PATH...] <FILE: prints the member at each PATH ("seconds.read", "rows.0") of a JSON object, six digits a number, one a line;
 * without a PATH prints "valid". Exit status 1 when the input is not one JSON object, 2 when it has no such member. */
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static json_t *member_at(json_t *value, char *path)
{
    char *word;
    while (value && (word = strsep(&path, ".")))
        value = json_is_array(value) ? json_array_get(value, strtoul(word, NULL, 10)) : json_object_get(value, word);
    return value;
}

int main(int argc, char **argv)
{
    json_error_t error;
    int status = 0;
    json_t *whole = json_loadf(stdin, JSON_REJECT_DUPLICATES, &error);
    if (!whole || !json_is_object(whole)) {
        printf("no JSON object: line %d: %s\n", error.line, error.text);
        return 1;
    }
    if (argc == 1) puts("valid");
    for (int i = 1; i < argc; i++) {
        json_t *value = member_at(whole, argv[i]);
        if (!value) status = 2;
        if (value && json_dumpf(value, stdout, JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(6))) status = 1;
        puts(value ? "" : "missing");
    }
    json_decref(whole);
    return status;
}
