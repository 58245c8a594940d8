/* image.c - see image.h. */
#include "image.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <png.h>

/* OpenEXR's headers have unnamed unions, which C99 does not know. */
#ifdef __GNUC__
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#endif
#include <openexr.h>
#ifdef __GNUC__
#pragma GCC diagnostic pop
#endif

enum { MAX_SIDE = 32768, MAX_PIXELS = 1 << 28 };

#ifdef __GNUC__
__attribute__((format(printf, 3, 4)))
#endif
static int
fail(char *message, size_t size, const char *format, ...)
{
	va_list arguments;
	va_start(arguments, format);
	vsnprintf(message, size, format, arguments);
	va_end(arguments);
	return -1;
}

int image_alloc(struct image *image, int width, int height, char *message, size_t size)
{
	image->width = image->height = 0;
	image->rgb = NULL;
	if (width < 1 || height < 1 || width > MAX_SIDE || height > MAX_SIDE || width > MAX_PIXELS / height)
		return fail(message, size, "%d x %d pixels: not a size this program handles", width, height);
	image->rgb = calloc((size_t)width * (size_t)height * 3, sizeof *image->rgb);
	if (!image->rgb)
		return fail(message, size, "out of memory for %d x %d pixels", width, height);
	image->width = width;
	image->height = height;
	return 0;
}

void image_free(struct image *image)
{
	free(image->rgb);
	image->rgb = NULL;
	image->width = image->height = 0;
}

/* --- OpenEXR --------------------------------------------------------------------------------------------------- */

/* The library reports through a callback of the context and returns a code; the callback's text is the better one. */
struct exr_report {
	char text[256];
};

static void exr_on_error(exr_const_context_t context, exr_result_t code, const char *text)
{
	struct exr_report *report = NULL;
	(void)code;
	if (exr_get_user_data(context, (void **)&report) == EXR_ERR_SUCCESS && report && !report->text[0])
		snprintf(report->text, sizeof report->text, "%s", text);
}

static int exr_fail(const struct exr_report *report, exr_result_t code, const char *path, char *message, size_t size)
{
	/* The library begins some of its texts with the file's name, which the message already has. */
	const char *text = report->text[0] ? report->text : exr_get_default_error_message(code);
	const size_t n = strlen(path);
	if (text[0] == '\'' && !strncmp(text + 1, path, n) && !strncmp(text + 1 + n, "': ", 3))
		text += n + 4;
	return fail(message, size, "%s: %s", path, text);
}

/* Where channel name goes in an RGB pixel: 0, 1, 2, 3 for all of them (luminance), -1 for nowhere. */
static int exr_slot(const char *name, int grey)
{
	if (grey)
		return strcmp(name, "Y") ? -1 : 3;
	if (name[0] && !name[1])
		return name[0] == 'R' ? 0 : (name[0] == 'G' ? 1 : (name[0] == 'B' ? 2 : -1));
	return -1;
}

static int exr_check_channels(const exr_attr_chlist_t *list, const char *path, int *grey, char *message, size_t size)
{
	int found[4] = {0, 0, 0, 0};
	for (int pass = 0; pass < 2; pass++)
		for (int i = 0; i < list->num_channels; i++) {
			const exr_attr_chlist_entry_t *c = &list->entries[i];
			const int slot = exr_slot(c->name.str, pass);
			if (slot < 0)
				continue;
			if (c->x_sampling != 1 || c->y_sampling != 1)
				return fail(message, size, "%s: channel %s is subsampled", path, c->name.str);
			found[slot] = 1;
		}
	*grey = !(found[0] && found[1] && found[2]);
	if (*grey && !found[3])
		return fail(message, size, "%s: has neither channels R, G and B nor Y", path);
	return 0;
}

/* Points the channels of a chunk that starts at row y, column x of the image into it. */
static void exr_aim(exr_decode_pipeline_t *decode, const struct image *image, int x, int y, int grey)
{
	for (int i = 0; i < decode->channel_count; i++) {
		exr_coding_channel_info_t *c = &decode->channels[i];
		const int slot = exr_slot(c->channel_name, grey);
		c->decode_to_ptr = NULL;
		if (slot < 0)
			continue;
		c->user_data_type = EXR_PIXEL_FLOAT;
		c->user_bytes_per_element = sizeof(float);
		c->user_pixel_stride = 3 * (int32_t)sizeof(float);
		c->user_line_stride = 3 * (int32_t)sizeof(float) * image->width;
		c->decode_to_ptr = (uint8_t *)(image->rgb + ((size_t)y * (size_t)image->width + (size_t)x) * 3 +
					       (slot == 3 ? 0 : slot));
	}
}

/* Scanline files come in chunks of some rows, tiled ones in tiles; both decode the same way. */
static exr_result_t exr_read_pixels(exr_context_t file, const struct image *image, int top, int tiled, int grey)
{
	exr_decode_pipeline_t decode = EXR_DECODE_PIPELINE_INITIALIZER;
	exr_chunk_info_t chunk;
	int32_t step_x = image->width, step_y = 1;
	int first = 1;
	exr_result_t code = tiled ? exr_get_tile_sizes(file, 0, 0, 0, &step_x, &step_y)
				  : exr_get_scanlines_per_chunk(file, 0, &step_y);
	if (code == EXR_ERR_SUCCESS && (step_x < 1 || step_y < 1))
		code = EXR_ERR_INVALID_ATTR;
	for (int y = 0; code == EXR_ERR_SUCCESS && y < image->height; y += step_y)
		for (int x = 0; code == EXR_ERR_SUCCESS && x < image->width; x += step_x) {
			code = tiled ? exr_read_tile_chunk_info(file, 0, x / step_x, y / step_y, 0, 0, &chunk)
				     : exr_read_scanline_chunk_info(file, 0, top + y, &chunk);
			if (code != EXR_ERR_SUCCESS)
				break;
			/* What is outside the image would be written outside it. */
			if (chunk.width > image->width - x || chunk.height > image->height - y) {
				code = EXR_ERR_BAD_CHUNK_LEADER;
				break;
			}
			code = first ? exr_decoding_initialize(file, 0, &chunk, &decode)
				     : exr_decoding_update(file, 0, &chunk, &decode);
			if (code != EXR_ERR_SUCCESS)
				break;
			exr_aim(&decode, image, x, y, grey);
			if (first)
				code = exr_decoding_choose_default_routines(file, 0, &decode);
			first = 0;
			if (code == EXR_ERR_SUCCESS)
				code = exr_decoding_run(file, 0, &decode);
		}
	exr_decoding_destroy(file, &decode);
	return code;
}

int image_read_exr(struct image *image, const char *path, char *message, size_t size)
{
	struct exr_report report = {""};
	exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
	exr_context_t file = NULL;
	exr_storage_t storage = EXR_STORAGE_SCANLINE;
	exr_attr_box2i_t window;
	const exr_attr_chlist_t *channels = NULL;
	int grey = 0, status = -1;

	memset(&window, 0, sizeof window);
	image->width = image->height = 0;
	image->rgb = NULL;
	init.error_handler_fn = exr_on_error;
	init.user_data = &report;
	init.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
	exr_result_t code = exr_start_read(&file, path, &init);
	if (code == EXR_ERR_SUCCESS)
		code = exr_get_storage(file, 0, &storage);
	if (code == EXR_ERR_SUCCESS)
		code = exr_get_data_window(file, 0, &window);
	if (code == EXR_ERR_SUCCESS)
		code = exr_get_channels(file, 0, &channels);

	const int64_t width = (int64_t)window.max.x - window.min.x + 1;
	const int64_t height = (int64_t)window.max.y - window.min.y + 1;
	if (code != EXR_ERR_SUCCESS)
		exr_fail(&report, code, path, message, size);
	else if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
		fail(message, size, "%s: deep data; only scanline and tiled images are read", path);
	else if (width < 1 || height < 1 || width > MAX_SIDE || height > MAX_SIDE)
		fail(message, size, "%s: %lld x %lld pixels: not a size this program handles", path, (long long)width,
		     (long long)height);
	else if (exr_check_channels(channels, path, &grey, message, size) == 0 &&
		 image_alloc(image, (int)width, (int)height, message, size) == 0) {
		code = exr_read_pixels(file, image, window.min.y, storage == EXR_STORAGE_TILED, grey);
		if (code == EXR_ERR_SUCCESS)
			status = 0;
		else if (code != EXR_ERR_FEATURE_NOT_IMPLEMENTED)
			exr_fail(&report, code, path, message, size);
		else {
			image_free(image);
			status = image_read_dwa(image, path, message, size);
			grey = 0;
		}
	}
	if (status == 0 && grey)
		for (size_t i = 0; i < (size_t)width * (size_t)height; i++)
			image->rgb[3 * i + 1] = image->rgb[3 * i + 2] = image->rgb[3 * i];
	if (status != 0)
		image_free(image);
	if (file)
		exr_finish(&file);
	return status;
}

static exr_result_t exr_write_pixels(exr_context_t file, const struct image *image)
{
	exr_encode_pipeline_t encode = EXR_ENCODE_PIPELINE_INITIALIZER;
	exr_chunk_info_t chunk;
	int32_t step = 1;
	exr_result_t code = exr_get_scanlines_per_chunk(file, 0, &step);
	for (int y = 0; code == EXR_ERR_SUCCESS && y < image->height; y += step) {
		code = exr_write_scanline_chunk_info(file, 0, y, &chunk);
		if (code != EXR_ERR_SUCCESS)
			break;
		code = y == 0 ? exr_encoding_initialize(file, 0, &chunk, &encode)
			      : exr_encoding_update(file, 0, &chunk, &encode);
		if (code != EXR_ERR_SUCCESS)
			break;
		for (int i = 0; i < encode.channel_count; i++) {
			exr_coding_channel_info_t *c = &encode.channels[i];
			c->user_data_type = EXR_PIXEL_FLOAT;
			c->user_bytes_per_element = sizeof(float);
			c->user_pixel_stride = 3 * (int32_t)sizeof(float);
			c->user_line_stride = 3 * (int32_t)sizeof(float) * image->width;
			c->encode_from_ptr = (const uint8_t *)(image->rgb + (size_t)y * (size_t)image->width * 3 +
							       exr_slot(c->channel_name, 0));
		}
		if (y == 0)
			code = exr_encoding_choose_default_routines(file, 0, &encode);
		if (code == EXR_ERR_SUCCESS)
			code = exr_encoding_run(file, 0, &encode);
	}
	exr_encoding_destroy(file, &encode);
	return code;
}

int image_write_exr(const struct image *image, const char *path, char *message, size_t size)
{
	struct exr_report report = {""};
	exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
	exr_context_t file = NULL;
	int part = 0;
	init.error_handler_fn = exr_on_error;
	init.user_data = &report;
	exr_result_t code = exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &init);
	if (code == EXR_ERR_SUCCESS)
		code = exr_add_part(file, "picture", EXR_STORAGE_SCANLINE, &part);
	if (code == EXR_ERR_SUCCESS)
		code = exr_initialize_required_attr_simple(file, part, image->width, image->height,
							   EXR_COMPRESSION_ZIP);
	for (const char *name = "BGR"; code == EXR_ERR_SUCCESS && *name; name++) {
		const char channel[2] = {*name, '\0'};
		code = exr_add_channel(file, part, channel, EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
	}
	if (code == EXR_ERR_SUCCESS)
		code = exr_write_header(file);
	if (code == EXR_ERR_SUCCESS)
		code = exr_write_pixels(file, image);
	/* Closing writes what is still buffered, so that it can fail too. */
	const exr_result_t closed = file ? exr_finish(&file) : EXR_ERR_SUCCESS;
	if (code == EXR_ERR_SUCCESS)
		code = closed;
	return code == EXR_ERR_SUCCESS ? 0 : exr_fail(&report, code, path, message, size);
}

/* --- PNG ------------------------------------------------------------------------------------------------------- */

/* The tone curve "PBR Neutral" of the Khronos Group (2024), made for pictures of materials: what is not a highlight
 * keeps its colour (a filmic curve would change gold's hue), what is brighter rolls off towards white. */
static void tone(float c[3])
{
	const float start = 0.8f - 0.04f, desaturation = 0.15f;
	const float low = fminf(c[0], fminf(c[1], c[2]));
	const float offset = low < 0.08f ? low - 6.25f * low * low : 0.04f;
	for (int i = 0; i < 3; i++)
		c[i] -= offset;
	const float peak = fmaxf(c[0], fmaxf(c[1], c[2]));
	if (peak < start)
		return;
	const float d = 1.0f - start;
	const float new_peak = 1.0f - d * d / (peak + d - start);
	const float white = 1.0f - 1.0f / (desaturation * (peak - new_peak) + 1.0f);
	for (int i = 0; i < 3; i++)
		c[i] = c[i] * new_peak / peak * (1.0f - white) + new_peak * white;
}

static uint8_t srgb_byte(float x)
{
	const float y = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
	return (uint8_t)(fminf(fmaxf(y, 0.0f), 1.0f) * 255.0f + 0.5f);
}

static int write_png(const struct image *image, const char *path, float scale, int toned, char *message, size_t size)
{
	const size_t n = (size_t)image->width * (size_t)image->height;
	uint8_t *bytes = malloc(n * 3);
	if (!bytes)
		return fail(message, size, "%s: out of memory", path);
	for (size_t i = 0; i < n; i++) {
		float c[3];
		for (int k = 0; k < 3; k++)
			c[k] = fmaxf(image->rgb[3 * i + (size_t)k] * scale, 0.0f);
		if (toned)
			tone(c);
		for (int k = 0; k < 3; k++)
			bytes[3 * i + (size_t)k] = srgb_byte(c[k]);
	}
	png_image png;
	memset(&png, 0, sizeof png);
	png.version = PNG_IMAGE_VERSION;
	png.width = (png_uint_32)image->width;
	png.height = (png_uint_32)image->height;
	png.format = PNG_FORMAT_RGB;
	const int ok = png_image_write_to_file(&png, path, 0, bytes, 0, NULL);
	free(bytes);
	return ok ? 0 : fail(message, size, "%s: %s", path, png.message);
}

int image_write_png(const struct image *image, const char *path, float exposure, char *message, size_t size)
{
	return write_png(image, path, exp2f(exposure), 1, message, size);
}

int image_write_png_plain(const struct image *image, const char *path, char *message, size_t size)
{
	return write_png(image, path, 1.0f, 0, message, size);
}
