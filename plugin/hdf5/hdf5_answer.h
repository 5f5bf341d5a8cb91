/* What pia-hdf5 tells the library on its channel: the array as an NPY file, or a sentence that says what is wrong; then the end mark,
 * without which it broke off. */
#ifndef PIA_HDF5_ANSWER_H
#define PIA_HDF5_ANSWER_H

#define PIA_HDF5_END "\npia-hdf5 end\n"

#endif
