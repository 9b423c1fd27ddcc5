// SPDX-License-Identifier: BSD-3-Clause
package geomap_spy;

import bot_core.image_t;
import geomap.rgbd_frame_t;
import java.awt.Color;
import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.zip.InflaterInputStream;
import javax.imageio.ImageIO;

/** Draws the images of a frame, which may hold anything. */
public final class FramePictures {
  private static final int MAX_SIDE = 8192; // [pixel]
  private static final int MAX_PADDING = 4096; // of a row [byte]
  private static final int NO_READING = 65535; // as is 0
  private static final int NEAR = 500; // red [mm]
  private static final int FAR = 5000; // blue [mm]
  private static final int[] COLOR_OF_DEPTH = new int[NO_READING + 1];

  static {
    for (int depth = 1; depth < NO_READING; ++depth) {
      float share = (float) (Math.min(Math.max(depth, NEAR), FAR) - NEAR) / (FAR - NEAR);
      COLOR_OF_DEPTH[depth] = Color.HSBtoRGB(share * 2 / 3, 1, 1);
    }
  }

  private FramePictures() {}

  /** Red is near, blue is far, black is without reading. */
  public static BufferedImage depth(rgbd_frame_t frame) throws IOException {
    image_t image = frame.depth;
    int stride = stride(image, 2);
    byte[] rows = image.data;
    if (image.pixelformat == rgbd_frame_t.DEPTH_ZLIB) {
      rows = new InflaterInputStream(new ByteArrayInputStream(rows))
                 .readNBytes(stride * image.height);
    } else if (image.pixelformat != image_t.PIXEL_FORMAT_LE_GRAY16) {
      throw new IOException("unknown pixel format " + image.pixelformat);
    }
    if (rows.length != stride * image.height) throw new IOException("ends early");
    ByteBuffer pixels = ByteBuffer.wrap(rows).order(ByteOrder.LITTLE_ENDIAN);
    return draw(image, (u, v) ->
        COLOR_OF_DEPTH[Short.toUnsignedInt(pixels.getShort(v * stride + 2 * u))]);
  }

  /** Null when the frame has no colour. */
  public static BufferedImage color(rgbd_frame_t frame) throws IOException {
    image_t image = frame.color;
    if (image.size == 0) return null;
    if (image.pixelformat == image_t.PIXEL_FORMAT_MJPEG) {
      BufferedImage picture = ImageIO.read(new ByteArrayInputStream(image.data));
      if (picture == null) throw new IOException("no JPEG");
      return picture;
    }
    int stride = stride(image, 3);
    if (image.pixelformat != image_t.PIXEL_FORMAT_RGB) {
      throw new IOException("unknown pixel format " + image.pixelformat);
    }
    if (image.size != stride * image.height) throw new IOException("ends early");
    return draw(image, (u, v) -> {
      int first = v * stride + 3 * u;
      return (image.data[first] & 0xff) << 16 | (image.data[first + 1] & 0xff) << 8
          | (image.data[first + 2] & 0xff);
    });
  }

  private interface ColorOfPixel {
    int at(int column, int row);
  }

  private static BufferedImage draw(image_t image, ColorOfPixel color) {
    BufferedImage picture =
        new BufferedImage(image.width, image.height, BufferedImage.TYPE_INT_RGB);
    for (int v = 0; v < image.height; ++v) {
      for (int u = 0; u < image.width; ++u) picture.setRGB(u, v, color.at(u, v));
    }
    return picture;
  }

  /** From one row to the next one [byte]. */
  private static int stride(image_t image, int pixelSize) throws IOException {
    if (image.width <= 0 || image.width > MAX_SIDE || image.height <= 0
        || image.height > MAX_SIDE) {
      throw new IOException("size of " + image.width + " x " + image.height);
    }
    int tight = pixelSize * image.width;
    int stride = image.row_stride == 0 ? tight : image.row_stride;
    if (stride < tight || stride > tight + MAX_PADDING) {
      throw new IOException("rows of " + stride + " bytes");
    }
    return stride;
  }
}
