/* The parts of the reader of HDF5 files: a program of its own, so that nothing a file does to HDF5 reaches who reads it. */
#ifndef PIA_HDF5_READER_H
#define PIA_HDF5_READER_H

#include <hdf5.h>
#include <stddef.h>

/* Both end the program when nobody listens. */
void answer_bytes(const void *bytes, size_t size);
/* Tells what is wrong, in one sentence, and ends the program. */
_Noreturn void answer_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Whether a data set is an array of numbers with one to three directions. */
int is_array(hid_t set);
/* The array as an NPY file of doubles. */
void send_array(hid_t file, hid_t set, const char *name);

#endif
