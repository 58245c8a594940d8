/* table.h - tabulated functions that a lobe carries by handle.
 *
 * A table is an array of floats on the host, whose first word is its own length in words; a lobe's parameters hold
 * where it stands. In C that is the array itself. A scene (batch.h) keeps a copy of every table its materials use in
 * one flat buffer, on the device in OpenCL, and gives its kernels handles into that. Handles are two 32-bit words, so
 * that structs that hold one have the same layout everywhere. */
#ifndef LOBE_CORE_TABLE_H
#define LOBE_CORE_TABLE_H

#include "../backend/backend.h"

/* 0, 0: no table. */
typedef struct {
	lobe_uint low, high;
} lobe_table;

/* address: of the first word, by whatever numbers the backend gives its addresses. */
LOBE_FN lobe_table lobe_table_at(lobe_uint64 address)
{
	lobe_table t;
	t.low = (lobe_uint)(address & 0xffffffffu);
	t.high = (lobe_uint)(address >> 32);
	return t;
}

LOBE_FN lobe_uint64 lobe_table_address(lobe_table t) { return ((lobe_uint64)t.high << 32) | t.low; }

/* Word i of a table; 0 where there is no table (the host refuses a material that lacks one it needs). */
LOBE_FN lobe_real lobe_table_fetch(lobe_table t, lobe_uint i)
{
	const lobe_uint64 address = lobe_table_address(t);
	return address != 0 ? (lobe_real)LOBE_FETCH_FLOAT(address, i) : LOBE_R(0.0);
}

#endif
