// SPDX-License-Identifier: BSD-3-Clause
package geomap_spy;

import geomap.rgbd_frame_t;
import java.awt.BorderLayout;
import java.awt.event.ActionEvent;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.SwingUtilities;
import javax.swing.Timer;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/** Adds "Depth and colour" to what lcm-spy offers for a channel of frames on a right click. */
public final class FramePlugin implements SpyPlugin {
  private static final int PERIOD = 100; // [ms]

  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == rgbd_frame_t.LCM_FINGERPRINT;
  }

  /** lcm-spy has opened a window with an empty desktop when it performs the action. */
  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction("Depth and colour") {
      @Override
      public void actionPerformed(ActionEvent event) {
        FrameView view = new FrameView();
        desktop.setLayout(new BorderLayout());
        desktop.add(view);
        SwingUtilities.getWindowAncestor(desktop).setSize(1300, 540);
        Timer timer = new Timer(PERIOD, tick -> {
          if (channel.last instanceof rgbd_frame_t) view.show((rgbd_frame_t) channel.last);
          if (!view.isShowing()) ((Timer) tick.getSource()).stop();
        });
        timer.start();
      }
    };
  }
}
