// SPDX-License-Identifier: BSD-3-Clause
import geomap.rgbd_frame_t;
import geomap_spy.FramePictures;
import java.awt.image.BufferedImage;
import java.io.File;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import javax.imageio.ImageIO;
import lcm.spy.SpyPlugin;
import lcm.util.ClassDiscoverer;

/** Writes the pictures of encoded frames beside them: FILE.depth.png and FILE.color.png. */
public final class DrawFrames {
  public static void main(String[] files) throws IOException {
    ClassDiscoverer.findClasses((jar, found) -> { // as lcm-spy looks for plugins
      if (SpyPlugin.class.isAssignableFrom(found)) System.out.println("plugin " + found.getName());
    });
    for (String file : files) {
      try {
        rgbd_frame_t frame = new rgbd_frame_t(Files.readAllBytes(Path.of(file)));
        write(FramePictures.depth(frame), file + ".depth.png");
        write(FramePictures.color(frame), file + ".color.png");
      } catch (IOException damaged) {
        System.out.println(Path.of(file).getFileName() + ": " + damaged.getMessage());
      }
    }
  }

  private static void write(BufferedImage picture, String file) throws IOException {
    if (picture != null) ImageIO.write(picture, "png", new File(file));
  }
}
