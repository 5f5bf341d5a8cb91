/* pia-hdf5 NAME PATH: the array NAME of an HDF5 file, or with an empty NAME its only one, on descriptor 3 (hdf5_answer.h). Started by
 * the library. */
#include "reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hdf5_answer.h"
#include "plugin_limit.h"

/* The arrays of a file as "/a, /b", as far as they find room. */
typedef struct arrays {
    int count;
    char first[1024], list[160];
} arrays;

static herr_t note_array(hid_t group, const char *name, const H5L_info_t *about, void *user)
{
    arrays *found = user;
    hid_t object = about->type == H5L_TYPE_HARD ? H5Oopen(group, name, H5P_DEFAULT) : H5I_INVALID_HID;
    if (object < 0) return 0;
    if (H5Iget_type(object) == H5I_DATASET && is_array(object)) {
        size_t used = strlen(found->list);
        if (found->count++ == 0) snprintf(found->first, sizeof found->first, "/%s", name);
        if (used + strlen(name) + 6 < sizeof found->list)
            snprintf(found->list + used, sizeof found->list - used, "%s/%s", used > 0 ? ", " : "", name);
        else if (used + 3 < sizeof found->list && found->list[used - 1] != '.')
            memcpy(found->list + used, "...", 4);
    }
    H5Oclose(object);
    return 0;
}

static void find_arrays(hid_t file, arrays *found)
{
    *found = (arrays){.count = 0};
    H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, note_array, found);
    if (found->count == 0) answer_error("holds no array of numbers with one to three directions");
}

static hid_t open_array(hid_t file, const char *path, const char *name, char used[1024])
{
    arrays found;
    snprintf(used, 1024, "%s", name);
    hid_t set = *name != '\0' ? H5Dopen(file, name, H5P_DEFAULT) : H5I_INVALID_HID;
    if (set >= 0) return set;
    find_arrays(file, &found);
    if (*name != '\0') answer_error("holds no array '%.80s'; there is %s", name, found.list);
    if (found.count > 1) answer_error("holds several arrays, %s; write %.80s:%.80s", found.list, path, found.first);
    snprintf(used, 1024, "%s", found.first);
    set = H5Dopen(file, found.first, H5P_DEFAULT);
    if (set < 0) answer_error("the array '%.80s' cannot be opened; copy the file again", found.first);
    return set;
}

int main(int argc, char **argv)
{
    char name[1024];
    if (argc != 3) {
        fprintf(stderr, "usage: pia-hdf5 NAME PATH 3>ANSWER\n");
        return 2;
    }
    plugin_limit(argv[2], 1000000, 16);
    H5Eset_auto(H5E_DEFAULT, NULL, NULL);        /* failures are told by answer_error */
    setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1); /* reading needs no lock, and some file systems have none */
    hid_t file = H5Fopen(argv[2], H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) answer_error("it is not an HDF5 file, or a damaged one");
    send_array(file, open_array(file, argv[2], argv[1], name), name);
    answer_bytes(PIA_HDF5_END, strlen(PIA_HDF5_END));
    return 0;
}
