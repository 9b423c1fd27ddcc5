// SPDX-License-Identifier: BSD-3-Clause
package geomap_spy;

import geomap.rgbd_frame_t;
import java.awt.BorderLayout;
import java.awt.Graphics;
import java.awt.GridLayout;
import java.awt.image.BufferedImage;
import java.io.IOException;
import javax.swing.JLabel;
import javax.swing.JPanel;

/** The newest frame of a channel: depth to the left, colour to the right, what it is below. */
final class FrameView extends JPanel {
  private final Picture depth = new Picture();
  private final Picture color = new Picture();
  private final JLabel caption = new JLabel("no frame yet");
  private rgbd_frame_t shown;

  FrameView() {
    super(new BorderLayout());
    JPanel pictures = new JPanel(new GridLayout(1, 2));
    pictures.add(depth);
    pictures.add(color);
    add(pictures);
    add(caption, BorderLayout.SOUTH);
  }

  void show(rgbd_frame_t frame) {
    if (frame == shown) return;
    shown = frame;
    caption.setText(String.format("%s, frame %d, utime %d; depth: red 0.5 m to blue 5 m%s%s",
        frame.sensor, frame.sequence, frame.utime, depth.show(frame, FramePictures::depth),
        color.show(frame, FramePictures::color)));
  }

  private interface Drawing {
    BufferedImage of(rgbd_frame_t frame) throws IOException;
  }

  /** Fits its picture into the room there is. */
  private static final class Picture extends JPanel {
    private BufferedImage picture;

    /** What is wrong with it, for the caption. */
    String show(rgbd_frame_t frame, Drawing drawing) {
      String fault = "";
      try {
        picture = drawing.of(frame);
      } catch (IOException damaged) {
        picture = null;
        fault = "; damaged image: " + damaged.getMessage();
      }
      repaint();
      return fault;
    }

    @Override
    protected void paintComponent(Graphics graphics) {
      super.paintComponent(graphics);
      if (picture == null) return;
      double scale = Math.min((double) getWidth() / picture.getWidth(),
          (double) getHeight() / picture.getHeight());
      graphics.drawImage(picture, 0, 0, (int) (scale * picture.getWidth()),
          (int) (scale * picture.getHeight()), null);
    }
  }
}
